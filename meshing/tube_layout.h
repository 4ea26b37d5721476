#pragma once

#include <cstdint>
#include <vector>

#include "graph/skeleton_graph.h"
#include "meshing/contacts.h"
#include "meshing/sweep.h"
#include "meshing/tube_paths.h"

namespace curvefusion {

struct TubeOptions;

/// Tubes ready to be triangulated: none intersects itself.
struct TubeLayout {
  std::vector<TubePath> paths;
  std::vector<TubeRings> rings;                  ///< of every path
  std::vector<std::vector<TubeStretch>> groups;  ///< what touches (GroupContacts)
};

/// Lays out the tubes of a skeleton: chains its branches, cuts tubes where they would touch or fold
/// into themselves, sweeps the rings (checked exactly for self-intersections) and groups what
/// touches. The seed turns the polygons of the tubes. Throws as PrepareTubes does.
TubeLayout LayOutTubes(const SkeletonGraph& graph, const TubeOptions& options, uint64_t seed);

}  // namespace curvefusion
