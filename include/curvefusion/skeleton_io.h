#pragma once

/// Skeleton graphs from and to files: JSON, GraphML, SWC, PLY, OBJ, DXF, SVG, USD.

#include "graph/io/graph_io.h"
