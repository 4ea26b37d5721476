#pragma once

#include <filesystem>
#include <string>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Reads what a result is to be compared with: a skeleton.json with radii, a curves.json (an array
/// of {"diameter", "closed", "points"} in metres, welded where curves come within 1.2 mm), or a
/// folder with either, as SimulateScan writes it. Throws Error(kBadInput) for anything else, also
/// for a skeleton with edges without radius.
SkeletonGraph ReadTruth(const std::filesystem::path& path);

/// Throws Error(kBadInput) where an edge has no radius: the figures of such a truth would be wrong.
/// `source` names it in the error.
void RequireRadii(const SkeletonGraph& truth, const std::string& source);

}  // namespace curvefusion
