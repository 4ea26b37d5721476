#include "graph/skeleton_graph.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

#include "kernel/disjoint_sets.h"

namespace curvefusion {

namespace {

// Appends the values of a curve to those of another that ends where it begins; none if either has
// none.
void AppendValues(const std::vector<double>& values, std::vector<double>& to) {
  if (values.empty() || to.empty()) {
    to.clear();
  } else {
    to.insert(to.end(), values.begin() + 1, values.end());
  }
}

void Append(const SkeletonEdge& link, SkeletonEdge& chain) {
  chain.nodes[1] = link.nodes[1];
  chain.points.insert(chain.points.end(), link.points.begin() + 1, link.points.end());
  AppendValues(link.radii, chain.radii);
  AppendValues(link.observations, chain.observations);
}

// The values `first` to `last`, both included.
template <class T>
std::vector<T> Slice(const std::vector<T>& values, size_t first, size_t last) {
  if (values.empty()) return {};
  return {values.begin() + static_cast<std::ptrdiff_t>(first),
          values.begin() + static_cast<std::ptrdiff_t>(last) + 1};
}

// Makes room for more values; a quarter more at least where values have to move for it, so that
// many small calls cost no more than few large ones.
template <class T>
void ReserveMore(std::vector<T>& values, size_t more) {
  const size_t needed = values.size() + more;
  if (needed > values.capacity())
    values.reserve(std::max(needed, values.capacity() + values.capacity() / 4));
}

}  // namespace

void Reverse(SkeletonEdge& edge) {
  std::swap(edge.nodes[0], edge.nodes[1]);
  std::reverse(edge.points.begin(), edge.points.end());
  std::reverse(edge.radii.begin(), edge.radii.end());
  std::reverse(edge.observations.begin(), edge.observations.end());
}

SkeletonEdge PartOf(const SkeletonEdge& edge, size_t first, size_t last,
                    const std::array<NodeId, 2>& nodes) {
  return {nodes, Slice(edge.points, first, last), Slice(edge.radii, first, last),
          Slice(edge.observations, first, last)};
}

void SkeletonGraph::Versions::Reserve(size_t more) {
  ReserveMore(of_items_, more);
  ReserveMore(of_blocks_, more / kBlock + 1);
}

void SkeletonGraph::Versions::Set(int item, int version) {
  of_items_[item] = version;
  const size_t block = static_cast<size_t>(item) / kBlock;
  if (block >= of_blocks_.size()) of_blocks_.resize(block + 1);
  of_blocks_[block] = version;
}

bool SkeletonGraph::Versions::Has(int item) const {
  return item >= 0 && static_cast<size_t>(item) < of_items_.size() && of_items_[item] > 0;
}

std::vector<int> SkeletonGraph::Versions::ChangedSince(int version, int live_count) const {
  std::vector<int> changed;
  if (version == 0) changed.reserve(static_cast<size_t>(live_count));
  const auto count = static_cast<int>(of_items_.size());
  for (int first = 0; first < count; first += kBlock) {
    if (of_blocks_[first / kBlock] <= version) continue;
    for (int item = first; item < std::min(first + kBlock, count); ++item)
      if (of_items_[item] > version) changed.push_back(item);
  }
  return changed;
}

void SkeletonGraph::Reserve(size_t nodes, size_t edges) {
  ReserveMore(nodes_, nodes);
  node_versions_.Reserve(nodes);
  ReserveMore(edges_, edges);
  edge_versions_.Reserve(edges);
}

NodeId SkeletonGraph::AddNode(const Vec3& position) {
  const auto id = static_cast<NodeId>(nodes_.size());
  nodes_.emplace_back().position = position;  // moving a node costs ten times as much
  node_versions_.Add();
  TouchNode(id);
  ++node_count_;
  ++isolated_count_;
  return id;
}

EdgeId SkeletonGraph::AddEdge(SkeletonEdge edge) {
  assert(edge.points.size() >= 2);
  assert(edge.points.front() == position(edge.nodes[0]));
  assert(edge.points.back() == position(edge.nodes[1]));
  assert(edge.radii.empty() || edge.radii.size() == edge.points.size());
  assert(edge.observations.empty() || edge.observations.size() == edge.points.size());
  const EdgeId id = static_cast<EdgeId>(edges_.size());
  for (const NodeId node : edge.nodes) {
    Attach(node, id);
    TouchNode(node);
  }
  point_count_ += edge.points.size();
  edges_.push_back(std::move(edge));
  edge_versions_.Add();
  TouchEdge(id);
  ++edge_count_;
  return id;
}

EdgeId SkeletonGraph::AddPolyline(Polyline points) {
  assert(points.size() >= 2);
  const NodeId first = AddNode(points.front());
  const NodeId last = points.back() == points.front() ? first : AddNode(points.back());
  return AddEdge({{first, last}, std::move(points), {}, {}});
}

void SkeletonGraph::Attach(NodeId node, EdgeId edge) {
  isolated_count_ -= nodes_[node].edges.empty() ? 1 : 0;
  nodes_[node].edges.push_back(edge);
}

void SkeletonGraph::Detach(NodeId node, EdgeId edge) {
  auto& incident = nodes_[node].edges;
  incident.erase(std::find(incident.begin(), incident.end(), edge));
  isolated_count_ += incident.empty() ? 1 : 0;
  TouchNode(node);
}

SkeletonEdge SkeletonGraph::TakeEdge(EdgeId edge) {
  assert(HasEdge(edge));
  SkeletonEdge taken = std::move(edges_[edge]);
  for (const NodeId node : taken.nodes) Detach(node, edge);
  edge_versions_.SetRemoved(edge);
  --edge_count_;
  point_count_ -= taken.points.size();
  return taken;
}

void SkeletonGraph::RemoveNode(NodeId node) {
  assert(HasNode(node) && Degree(node) == 0);
  node_versions_.SetRemoved(node);
  --node_count_;
  --isolated_count_;
}

void SkeletonGraph::RemoveIsolatedNodes(int since) {
  if (isolated_count_ == 0) return;
  for (const NodeId node : Nodes(since)) {
    if (Degree(node) == 0) RemoveNode(node);
  }
}

void SkeletonGraph::MoveNode(NodeId node, const Vec3& position) {
  nodes_[node].position = position;
  TouchNode(node);
  for (const EdgeId id : nodes_[node].edges) {
    SkeletonEdge& edge = edges_[id];
    TouchEdge(id);
    if (edge.nodes[0] == node) edge.points.front() = position;
    if (edge.nodes[1] == node) edge.points.back() = position;
  }
}

void SkeletonGraph::SetCurve(EdgeId edge, Polyline points, std::vector<double> radii,
                             std::vector<double> observations) {
  SkeletonEdge& target = edges_[edge];
  assert(points.front() == position(target.nodes[0]));
  assert(points.back() == position(target.nodes[1]));
  point_count_ += points.size() - target.points.size();
  target.points = std::move(points);
  target.radii = std::move(radii);
  target.observations = std::move(observations);
  TouchEdge(edge);
}

NodeId SkeletonGraph::SplitEdge(EdgeId edge, size_t point_index) {
  assert(point_index > 0 && point_index + 1 < this->edge(edge).points.size());
  const NodeId middle = AddNode(this->edge(edge).points[point_index]);
  const SkeletonEdge whole = TakeEdge(edge);
  AddEdge(PartOf(whole, 0, point_index, {whole.nodes[0], middle}));
  AddEdge(PartOf(whole, point_index, whole.points.size() - 1, {middle, whole.nodes[1]}));
  return middle;
}

void SkeletonGraph::MergeNodes(NodeId kept, NodeId merged) {
  assert(HasNode(kept) && HasNode(merged));
  if (kept == merged) return;
  MoveNode(merged, position(kept));  // touches the edges
  TouchNode(kept);
  const auto moved = nodes_[merged].edges;
  for (const EdgeId id : moved) {
    SkeletonEdge& edge = edges_[id];
    for (NodeId& node : edge.nodes) {
      if (node != merged) continue;
      node = kept;
      Attach(kept, id);
    }
  }
  isolated_count_ += moved.empty() ? 0 : 1;
  nodes_[merged].edges.clear();
  RemoveNode(merged);
  for (const EdgeId id : moved) {
    if (!HasEdge(id) || edge(id).nodes[0] != edge(id).nodes[1]) continue;
    if (Length(edge(id).points) <= 0) RemoveEdge(id);
  }
}

bool SkeletonGraph::IsInsideCurve(NodeId node) const {
  return Degree(node) == 2 && IncidentEdges(node)[0] != IncidentEdges(node)[1];
}

NodeId SkeletonGraph::OtherEnd(EdgeId edge, NodeId node) const {
  const std::array<NodeId, 2>& nodes = edges_[edge].nodes;
  return nodes[0] == node ? nodes[1] : nodes[0];
}

SkeletonEdge SkeletonGraph::TakeChain(NodeId first, EdgeId next) {
  SkeletonEdge chain = TakeEdge(next);
  if (chain.nodes[0] != first) Reverse(chain);
  for (NodeId node = chain.nodes[1]; node != first && Degree(node) == 1; node = chain.nodes[1]) {
    next = IncidentEdges(node)[0];
    SkeletonEdge link = TakeEdge(next);
    if (link.nodes[0] != node) Reverse(link);
    RemoveNode(node);
    Append(link, chain);
  }
  return chain;
}

void SkeletonGraph::DissolveChainsFrom(NodeId node) {
  const auto incident = nodes_[node].edges;
  for (const EdgeId id : incident) {
    if (!HasEdge(id)) continue;
    const NodeId other = OtherEnd(id, node);
    if (other == node || !IsInsideCurve(other)) continue;
    AddEdge(TakeChain(node, id));
  }
}

void SkeletonGraph::DissolveDegree2Nodes(int since) {
  std::vector<NodeId> inside;
  std::vector<NodeId> ends;  // of chains of such nodes
  for (const NodeId node : Nodes(since)) {
    if (!IsInsideCurve(node)) continue;
    inside.push_back(node);
    for (const EdgeId id : IncidentEdges(node))
      if (!IsInsideCurve(OtherEnd(id, node))) ends.push_back(OtherEnd(id, node));
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  for (const NodeId node : ends) DissolveChainsFrom(node);
  // What is left are closed curves, which keep their first node.
  for (const NodeId node : inside)
    if (HasNode(node) && IsInsideCurve(node)) DissolveChainsFrom(node);
}

bool SkeletonGraph::HasNode(NodeId node) const { return node_versions_.Has(node); }

bool SkeletonGraph::HasEdge(EdgeId edge) const { return edge_versions_.Has(edge); }

const Vec3& SkeletonGraph::position(NodeId node) const {
  assert(HasNode(node));
  return nodes_[node].position;
}

const SkeletonEdge& SkeletonGraph::edge(EdgeId edge) const {
  assert(HasEdge(edge));
  return edges_[edge];
}

std::vector<NodeId> SkeletonGraph::Nodes(int since) const {
  return node_versions_.ChangedSince(since, node_count_);
}

std::vector<EdgeId> SkeletonGraph::Edges(int since) const {
  return edge_versions_.ChangedSince(since, edge_count_);
}

std::span<const EdgeId> SkeletonGraph::IncidentEdges(NodeId node) const {
  assert(HasNode(node));
  return {nodes_[node].edges.data(), nodes_[node].edges.size()};
}

double SkeletonGraph::TotalLength() const {
  double length = 0;
  for (const EdgeId id : Edges()) length += Length(edges_[id].points);
  return length;
}

int SkeletonGraph::ComponentCount() const {
  DisjointSets sets(nodes_.size());
  for (const EdgeId id : Edges()) sets.Unite(edges_[id].nodes[0], edges_[id].nodes[1]);
  int components = 0;
  for (const NodeId node : Nodes()) components += Degree(node) > 0 && sets.Root(node) == node;
  return components;
}

int SkeletonGraph::CycleRank() const {
  int used_nodes = 0;
  for (const NodeId node : Nodes()) used_nodes += Degree(node) > 0;
  return edge_count_ - used_nodes + ComponentCount();
}

Eigen::AlignedBox3d BoundsOf(const SkeletonGraph& graph) {
  Eigen::AlignedBox3d bounds;
  for (const EdgeId id : graph.Edges()) {
    for (const Vec3& p : graph.edge(id).points) bounds.extend(p);
  }
  return bounds;
}

void Append(const SkeletonGraph& more, SkeletonGraph& graph) {
  std::map<NodeId, NodeId> nodes;
  for (const NodeId node : more.Nodes()) nodes[node] = graph.AddNode(more.position(node));
  for (const EdgeId id : more.Edges()) {
    SkeletonEdge edge = more.edge(id);
    edge.nodes = {nodes[edge.nodes[0]], nodes[edge.nodes[1]]};
    graph.AddEdge(std::move(edge));
  }
}

SkeletonGraph Transformed(const SkeletonGraph& graph, const AffineTransform& T) {
  SkeletonGraph moved = graph;
  for (const NodeId node : graph.Nodes()) moved.MoveNode(node, T * graph.position(node));
  for (const EdgeId id : graph.Edges()) {
    SkeletonEdge edge = graph.edge(id);
    for (size_t i = 1; i + 1 < edge.points.size(); ++i) edge.points[i] = T * edge.points[i];
    edge.points.front() = moved.position(edge.nodes[0]);
    edge.points.back() = moved.position(edge.nodes[1]);
    moved.SetCurve(id, std::move(edge.points), std::move(edge.radii), std::move(edge.observations));
  }
  return moved;
}

}  // namespace curvefusion
