#pragma once

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// A volume found by sampling.
struct SampledVolume {
  double volume = 0;          ///< m^3
  double relative_error = 0;  ///< standard error over the volume
};

/// The volume of the union of a skeleton's tubes, found without meshing: a tube is the union of all
/// balls of the local radius about the points of its edges, which must have radii. Points are drawn
/// from all pieces in proportion to their volumes, and one that lies in k of them counts 1/k (Karp,
/// Luby and Madras 1989); the same points for the same graph. 0 without edges; `samples` must be
/// positive.
SampledVolume VolumeOfTubes(const SkeletonGraph& graph, int samples);

}  // namespace curvefusion
