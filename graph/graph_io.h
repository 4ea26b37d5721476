#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "graph/skeleton_graph.h"
#include "kernel/image.h"

namespace curvefusion {

/// The text of a skeleton.json: nodes and edges in ascending order of their handles, one a line,
/// every double in its shortest form that reads back to the same bits. An edge with radii has
/// `radius`, their mean, and `radii` only where they differ. Throws Error(kBadInput) where a value
/// is not finite, because JSON cannot hold it.
std::string SkeletonToJson(const SkeletonGraph& graph);

/// The graph of a skeleton.json; handles count up from 0 in the order of the file. `radius` alone
/// gives every point that radius. `source` names the input in errors. Throws Error(kBadInput) with
/// place and reason for anything that is not such a file: syntax, missing keys, another format or
/// version, numbers that are not finite, counts that do not match, edges of nodes that do not
/// exist, ends that differ from their nodes, repeated points, radii that are not positive.
SkeletonGraph SkeletonFromJson(const std::string& text, const std::string& source);

/// SkeletonToJson into a file, atomically.
void WriteSkeleton(const std::filesystem::path& path, const SkeletonGraph& graph);

/// SkeletonFromJson of a file. Throws Error(kBadInput) also where it cannot be read.
SkeletonGraph ReadSkeleton(const std::filesystem::path& path);

/// The polylines as an ASCII PLY of vertices and edges, to look at in a mesh viewer. `edge_colors`
/// is empty or holds one colour per edge, in the order of graph.Edges().
void WriteSkeletonLines(const std::filesystem::path& path, const SkeletonGraph& graph,
                        const std::vector<Rgb>& edge_colors = {});

}  // namespace curvefusion
