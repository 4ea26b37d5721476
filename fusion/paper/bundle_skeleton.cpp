#include "fusion/paper/bundle_skeleton.h"

#include <map>

namespace curvefusion {

namespace {

void Append(SkeletonGraph& graph, const SkeletonGraph& more) {
  std::map<NodeId, NodeId> nodes;
  for (const NodeId node : more.Nodes()) nodes[node] = graph.AddNode(more.position(node));
  for (const EdgeId id : more.Edges()) {
    SkeletonEdge edge = more.edge(id);
    edge.nodes = {nodes[edge.nodes[0]], nodes[edge.nodes[1]]};
    graph.AddEdge(std::move(edge));
  }
}

}  // namespace

SkeletonGraph ExtractBundleSkeleton(const std::vector<ObservedPoints>& clusters,
                                    const L1Options& options) {
  SkeletonGraph skeleton;
  for (const ObservedPoints& cluster : clusters) {
    Append(skeleton, ExtractL1Skeleton(cluster, options));
  }
  return skeleton;
}

}  // namespace curvefusion
