#pragma once

/// Meshes from and to files: PLY, OBJ, STL, GLB, 3MF; and whether one is watertight.

#include "meshing/io/mesh_io.h"
#include "meshing/watertight.h"
