#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// The kinds of hard networks that RandomHardGraph makes.
const std::vector<std::string>& HardKinds();

/// A random network of a kind that is hard to mesh; the same seed gives the same network.
SkeletonGraph RandomHardGraph(const std::string& kind, uint64_t seed);

}  // namespace curvefusion
