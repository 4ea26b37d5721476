#pragma once

/// Watertight tubes of a skeleton graph with radii (BuildTubes).

#include "meshing/tube_warnings.h"
#include "meshing/tubes.h"
