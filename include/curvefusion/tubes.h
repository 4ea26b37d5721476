#pragma once

/// Watertight tubes of a skeleton graph with radii. With <curvefusion/mesh_io.h>:
///
///     WriteMesh("wires.ply", ToTriangleMesh(BuildTubes(skeleton, {}).surface), {});

#include "meshing/tube_warnings.h"
#include "meshing/tubes.h"
