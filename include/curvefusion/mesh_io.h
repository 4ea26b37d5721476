#pragma once

/// @file
/// Triangle meshes from and to files: PLY, OBJ, STL, GLB, 3MF. WriteMesh reads back what it has
/// written before the file gets its name, and refuses a mesh that is not watertight unless it is
/// told that it need not be. ExamineMesh says whether a mesh is watertight, and what is wrong where
/// it is not. Link `curvefusion::meshing`.

#include "meshing/io/mesh_io.h"
#include "meshing/watertight.h"
