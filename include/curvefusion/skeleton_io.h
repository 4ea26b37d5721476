#pragma once

/// @file
/// Skeletons from and to files, by extension. ReadSkeleton: JSON, GraphML, SWC, PLY, OBJ.
/// ExportSkeleton: these and DXF, SVG, USD; it returns what the format does not keep, a sentence
/// each. ExportSplines: cubic B-splines as DXF, USD, STEP. Files appear when they are complete.
/// Link `curvefusion::graph`.

#include "graph/io/graph_io.h"
