#pragma once

#include <vector>

#include "meshing/tube_axis.h"
#include "meshing/tube_paths.h"

namespace curvefusion {

/// Of each segment of each path, balls along the curve as it was given, from which the rings of the
/// tube take their shape (SweepRings): where tubes graze (FindGrazingSegments), unless the tube is
/// as straight and round there as its axis. Empty elsewhere: rings are circles. `curves` are those
/// that TubePath::curves names, without repeated points. O(grazing segments times points of their
/// curves).
std::vector<std::vector<TubeAxis>> FindRoughStretches(const std::vector<TubePath>& paths,
                                                      const std::vector<TubeAxis>& curves);

}  // namespace curvefusion
