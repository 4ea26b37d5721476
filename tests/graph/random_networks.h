#pragma once

#include <cstdint>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// A network made to break things, and the threshold at which it is hardest.
struct RandomNetwork {
  SkeletonGraph graph;
  double threshold = 0;
};

/// Networks of many kinds, chosen by the seed: lattices of crossing wires; parallel and collinear
/// overlaps exactly at the threshold and one ulp to either side; coincident nodes, duplicates and
/// segments of length zero; ends that touch; spirals that touch themselves; segments through one
/// point; folds and figures of eight; soups of random walks; mixtures. At scales down to 1e-6 m,
/// offsets up to 1e6 m, with threshold zero and above, with and without radii and observations. At
/// most about `size` curves.
RandomNetwork MakeRandomNetwork(uint64_t seed, int size);

/// The same graph with nodes, edges and their directions in another order.
SkeletonGraph Shuffled(const SkeletonGraph& graph, uint64_t seed);

}  // namespace curvefusion
