#pragma once

#include <filesystem>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Writes a CSV that tells how to cut and bend the wire of every edge (docs/formats_output.md, "Cut
/// list"), atomically: a row a bend, and one for the end of each edge; millimetres and degrees.
/// `tolerance` (metres) is that of FindBends. Throws Error(kResource) where it cannot be written.
void WriteCutList(const std::filesystem::path& path, const SkeletonGraph& graph, double tolerance);

}  // namespace curvefusion
