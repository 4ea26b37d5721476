#pragma once

#include <optional>
#include <vector>

#include "graph/skeleton_graph.h"
#include "kernel/triangle_mesh.h"
#include "tests/meshing/tube_truth.h"

namespace curvefusion {

/// The union of a skeleton's tubes with balls wherever it may come out either way.
struct FilledTubes {
  std::vector<Ball> fillings;
  Topology topology;  ///< of tubes and fillings together
};

/// Fills grazing contacts: wherever a contact, hole or pocket comes or goes while all radii grow
/// from 1 - tolerance to 1 + tolerance, a ball of .4 radii is added, until nothing comes or goes
/// any more. What does is found exactly, as critical simplices of the weighted alpha complex; where
/// radii differ the tolerance is a part of the least at the place. A right mesh then has this
/// topology, too, when it is filled (TopologyOfFilled), whatever it makes of a grazing contact:
/// where two tubes touch along a line, polygons touch in several places with holes between. Nothing
/// where no end is found. O(n log n) for n balls, about .1 ms each.
std::optional<FilledTubes> FillGrazingContacts(const SkeletonGraph& graph, double tolerance);

/// The topology of what a closed mesh encloses and balls together. Nothing where their union does
/// not come out.
std::optional<Topology> TopologyOfFilled(const TriangleMesh& mesh, const std::vector<Ball>& balls);

}  // namespace curvefusion
