#pragma once

#include <string>
#include <vector>

#include "graph/skeleton_graph.h"
#include "meshing/tubes.h"

namespace curvefusion {

/// What the user should know of the tubes of a skeleton, a sentence each: radii that were assumed,
/// junctions that did not come out at once.
std::vector<std::string> TubeWarnings(const SkeletonGraph& skeleton, const TubeMesh& tubes,
                                      const TubeOptions& options);

}  // namespace curvefusion
