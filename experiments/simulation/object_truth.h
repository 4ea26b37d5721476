#pragma once

#include <filesystem>

#include "experiments/simulation/objects.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// The skeleton a perfect reconstruction of the object would have: a node where wires are welded,
/// at free ends, and one on each loop without a weld; radii from the diameters, one a point. Bends
/// of valence 2 are no nodes. By the rule of nearness wires are welded where their centre lines
/// come within 1.2 mm (contacts within 4 mm are one node).
SkeletonGraph TruthSkeleton(const WireObject& object);

/// The wires of a skeleton, one an edge, as thick as the edge at each point: an object to simulate.
/// `source` names the skeleton in errors. Throws Error(kBadInput) for a skeleton without edges or
/// with an edge without radius.
std::vector<WireCurve> WiresOf(const SkeletonGraph& skeleton, const std::string& source);

/// Writes the curves as an array of {"diameter", "closed", "points"} in metres, the input of an
/// independent scorer; a wire that tapers has "diameters" too, one a point. Throws Error(kResource)
/// where the file cannot be written.
void WriteCurves(const std::filesystem::path& path, const WireObject& object);

}  // namespace curvefusion
