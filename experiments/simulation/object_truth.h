#pragma once

#include <filesystem>

#include "experiments/simulation/objects.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// The skeleton a perfect reconstruction of the object would have: a node wherever the centre lines
/// of two wires come within 1.2 mm (contacts within 4 mm are one node), at free ends, and one on
/// each loop without contact; radii from the diameters. Bends of valence 2 are no nodes.
SkeletonGraph TruthSkeleton(const WireObject& object);

/// The wires of a skeleton, one an edge, as thick as the edge on average: an object to simulate.
/// `source` names the skeleton in errors. Throws Error(kBadInput) for a skeleton without edges or
/// with an edge without radius.
std::vector<WireCurve> WiresOf(const SkeletonGraph& skeleton, const std::string& source);

/// Writes the curves as an array of {"diameter", "closed", "points"} in metres, the input of an
/// independent scorer. Throws Error(kResource) where the file cannot be written.
void WriteCurves(const std::filesystem::path& path, const WireObject& object);

}  // namespace curvefusion
