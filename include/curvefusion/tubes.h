#pragma once

/// @file
/// Watertight tubes about the curves of a skeleton, by their radii. Link `curvefusion::meshing`.
///
///     const TubeMesh tubes = BuildTubes(skeleton, {});  // {}: default options
///     WriteMesh("wires.ply", ToTriangleMesh(tubes.surface), {});  // <curvefusion/mesh_io.h>
///     const std::vector<std::string> warnings = TubeWarnings(skeleton, tubes, {});
///
/// Curves without radii get TubeOptions::default_radius; TubeWarnings says so.

#include "meshing/tube_warnings.h"
#include "meshing/tubes.h"
