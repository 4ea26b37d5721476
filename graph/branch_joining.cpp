#include "graph/branch_joining.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "kernel/dbscan.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

constexpr int kNone = -1;

// A junction lies ahead of an end when it is seen within 60 degrees of the end's heading: the mean
// of a cluster strays from the branches' lines by about as much.
constexpr double kJunctionCosine = 0.5;

// How many vertices back the heading of an end is measured from.
constexpr size_t kHeadingVertices = 3;

struct Junctions {
  std::vector<Vec3> samples;
  std::vector<int> junction_of_sample;
  std::vector<Vec3> positions;
};

Junctions ClusterJunctions(std::vector<Vec3> samples, double link_distance) {
  Junctions junctions{std::move(samples), {}, {}};
  junctions.junction_of_sample = Dbscan(junctions.samples, link_distance, 1);
  const int count = junctions.samples.empty()
                        ? 0
                        : 1 + *std::max_element(junctions.junction_of_sample.begin(),
                                                junctions.junction_of_sample.end());
  junctions.positions.assign(count, Vec3::Zero());
  std::vector<int> sizes(count, 0);
  for (size_t i = 0; i < junctions.samples.size(); ++i) {
    junctions.positions[junctions.junction_of_sample[i]] += junctions.samples[i];
    ++sizes[junctions.junction_of_sample[i]];
  }
  for (int k = 0; k < count; ++k) junctions.positions[k] /= sizes[k];
  return junctions;
}

// Where a branch ends and which way it would go on.
struct BranchEnd {
  int branch;
  bool at_front;
  Vec3 position;
  Vec3 heading;
  int junction = kNone;
  NodeId node = kNone;
};

BranchEnd EndOf(const std::vector<Polyline>& branches, int branch, bool at_front) {
  const Polyline& points = branches[branch];
  const size_t inner = std::min(kHeadingVertices, points.size() - 1);
  const Vec3& tip = at_front ? points.front() : points.back();
  const Vec3& before = at_front ? points[inner] : points[points.size() - 1 - inner];
  return {branch, at_front, tip, (tip - before).normalized()};
}

class BranchJoiner {
 public:
  BranchJoiner(std::vector<Polyline> branches, Junctions junctions, double reach,
               double maximum_bend)
      : branches_(std::move(branches)),
        junctions_(std::move(junctions)),
        junction_index_(junctions_.samples),
        is_passed_(junctions_.positions.size(), 0),
        stops_(branches_.size()),
        reach_(reach),
        minimum_cosine_(std::cos(maximum_bend)) {
    for (int b = 0; b < static_cast<int>(branches_.size()); ++b)
      for (const bool at_front : {true, false}) ends_.push_back(EndOf(branches_, b, at_front));
  }

  void JoinAtJunctions();
  void BridgeGaps();
  void JoinAtSides();
  SkeletonGraph Build();

 private:
  struct Gap {
    double width;
    size_t first_end;
    size_t second_end;
  };
  void FindJunctions();
  bool ProlongLoneEnds();
  int JunctionAhead(const BranchEnd& end);
  void Prolong(BranchEnd& end, const Vec3& position);
  bool FaceEachOther(const BranchEnd& a, const BranchEnd& b) const;
  std::vector<Gap> Gaps();
  bool IsOwnTip(const BranchEnd& end, int branch, int vertex) const;
  NodeId NodeAtVertex(int branch, int vertex);
  Polyline CurveBetweenNodes(int branch) const;

  std::vector<Polyline> branches_;
  Junctions junctions_;
  PointIndex junction_index_;
  std::vector<char> is_passed_;               // junctions that have become part of a branch
  std::vector<std::map<int, NodeId>> stops_;  // inner vertices of each branch that became nodes
  double reach_;
  double minimum_cosine_;
  std::vector<BranchEnd> ends_;  // front and back of branch b at 2 b and 2 b + 1
  std::vector<int> neighbours_;
  SkeletonGraph graph_;
};

void BranchJoiner::JoinAtJunctions() {
  do FindJunctions();
  while (ProlongLoneEnds());
  std::vector<NodeId> node_of_junction(junctions_.positions.size(), kNone);
  for (BranchEnd& end : ends_) {
    if (end.junction == kNone) continue;
    NodeId& node = node_of_junction[end.junction];
    if (node == kNone) node = graph_.AddNode(junctions_.positions[end.junction]);
    end.node = node;
  }
}

void BranchJoiner::FindJunctions() {
  for (BranchEnd& end : ends_) {
    if (end.junction == kNone) end.junction = JunctionAhead(end);
  }
}

// A cluster reached by one end joins nothing. Returns whether there was one.
bool BranchJoiner::ProlongLoneEnds() {
  std::vector<int> end_count(junctions_.positions.size(), 0);
  for (const BranchEnd& end : ends_) {
    if (end.junction != kNone) ++end_count[end.junction];
  }
  bool any = false;
  for (BranchEnd& end : ends_) {
    if (end.junction == kNone || end_count[end.junction] != 1) continue;
    is_passed_[end.junction] = 1;
    Prolong(end, junctions_.positions[end.junction]);
    end.junction = kNone;
    any = true;
  }
  return any;
}

int BranchJoiner::JunctionAhead(const BranchEnd& end) {
  junction_index_.WithinRadius(end.position, reach_, neighbours_);
  int nearest = kNone;
  double nearest_distance = std::numeric_limits<double>::infinity();
  for (const int i : neighbours_) {
    const int junction = junctions_.junction_of_sample[i];
    const Vec3 to_center = junctions_.positions[junction] - end.position;
    const double distance = (junctions_.samples[i] - end.position).norm();
    if (is_passed_[junction] || distance >= nearest_distance) continue;
    if (to_center.dot(end.heading) < kJunctionCosine * to_center.norm()) continue;
    nearest = junction;
    nearest_distance = distance;
  }
  return nearest;
}

void BranchJoiner::Prolong(BranchEnd& end, const Vec3& position) {
  if (position == end.position) return;
  Polyline& points = branches_[end.branch];
  points.insert(end.at_front ? points.begin() : points.end(), position);
  end = EndOf(branches_, end.branch, end.at_front);
}

bool BranchJoiner::FaceEachOther(const BranchEnd& a, const BranchEnd& b) const {
  const Vec3 step = b.position - a.position;
  return step.dot(a.heading) >= 0 && step.dot(b.heading) <= 0 &&
         a.heading.dot(b.heading) <= -minimum_cosine_;
}

// The narrowest first.
std::vector<BranchJoiner::Gap> BranchJoiner::Gaps() {
  std::vector<Vec3> tips;
  for (const BranchEnd& end : ends_) tips.push_back(end.position);
  const PointIndex index(tips);
  std::vector<Gap> gaps;
  for (size_t a = 0; a < ends_.size(); ++a) {
    index.WithinRadius(tips[a], reach_, neighbours_);
    for (const int i : neighbours_) {
      const size_t b = static_cast<size_t>(i);
      if (b <= a || ends_[a].node != kNone || ends_[b].node != kNone) continue;
      if (FaceEachOther(ends_[a], ends_[b])) gaps.push_back({(tips[b] - tips[a]).norm(), a, b});
    }
  }
  std::stable_sort(gaps.begin(), gaps.end(),
                   [](const Gap& a, const Gap& b) { return a.width < b.width; });
  return gaps;
}

void BranchJoiner::BridgeGaps() {
  for (const Gap& gap : Gaps()) {
    BranchEnd& a = ends_[gap.first_end];
    BranchEnd& b = ends_[gap.second_end];
    if (a.node != kNone || b.node != kNone) continue;
    a.node = b.node = graph_.AddNode((a.position + b.position) / 2);
  }
}

// Whether a vertex belongs to the stretch of the branch that leads to its own end.
bool BranchJoiner::IsOwnTip(const BranchEnd& end, int branch, int vertex) const {
  if (branch != end.branch) return false;
  const Polyline& points = branches_[branch];
  const int tip = end.at_front ? 0 : static_cast<int>(points.size()) - 1;
  double length = 0;
  for (int i = std::min(vertex, tip); i < std::max(vertex, tip); ++i)
    length += (points[i + 1] - points[i]).norm();
  return length < 2 * reach_;
}

NodeId BranchJoiner::NodeAtVertex(int branch, int vertex) {
  const Polyline& points = branches_[branch];
  const bool is_front = vertex == 0;
  const bool is_back = vertex + 1 == static_cast<int>(points.size());
  NodeId& node = is_front  ? ends_[2 * branch].node
                 : is_back ? ends_[2 * branch + 1].node
                           : stops_[branch].try_emplace(vertex, kNone).first->second;
  if (node == kNone) node = graph_.AddNode(points[vertex]);
  return node;
}

void BranchJoiner::JoinAtSides() {
  std::vector<Vec3> vertices;
  std::vector<std::pair<int, int>> places;  // branch and vertex
  for (int b = 0; b < static_cast<int>(branches_.size()); ++b) {
    for (int v = 0; v < static_cast<int>(branches_[b].size()); ++v) {
      vertices.push_back(branches_[b][v]);
      places.emplace_back(b, v);
    }
  }
  const PointIndex index(vertices);
  for (BranchEnd& end : ends_) {
    if (end.node != kNone) continue;
    index.WithinRadius(end.position, reach_, neighbours_);
    int nearest = kNone;
    double nearest_distance = std::numeric_limits<double>::infinity();
    for (const int i : neighbours_) {
      const Vec3 step = vertices[i] - end.position;
      const double distance = step.norm();
      if (distance >= nearest_distance || step.dot(end.heading) <= minimum_cosine_ * distance)
        continue;
      if (IsOwnTip(end, places[i].first, places[i].second)) continue;
      nearest = i;
      nearest_distance = distance;
    }
    if (nearest != kNone) end.node = NodeAtVertex(places[nearest].first, places[nearest].second);
  }
}

// The branch with the positions of its end nodes, where those lie beyond it.
Polyline BranchJoiner::CurveBetweenNodes(int branch) const {
  Polyline curve = branches_[branch];
  const Vec3& first = graph_.position(ends_[2 * branch].node);
  const Vec3& last = graph_.position(ends_[2 * branch + 1].node);
  if (first != curve.front()) curve.insert(curve.begin(), first);
  if (last != curve.back()) curve.push_back(last);
  return curve;
}

SkeletonGraph BranchJoiner::Build() {
  for (BranchEnd& end : ends_) {
    if (end.node == kNone) end.node = graph_.AddNode(end.position);
  }
  for (int b = 0; b < static_cast<int>(branches_.size()); ++b) {
    const Polyline curve = CurveBetweenNodes(b);
    const int shift = curve[0] == branches_[b][0] ? 0 : 1;
    std::map<int, NodeId> stops;
    for (const auto& [vertex, node] : stops_[b]) stops[vertex + shift] = node;
    stops[static_cast<int>(curve.size()) - 1] = ends_[2 * b + 1].node;
    int start = 0;
    NodeId start_node = ends_[2 * b].node;
    for (const auto& [vertex, node] : stops) {
      graph_.AddEdge({{start_node, node},
                      Polyline(curve.begin() + start, curve.begin() + vertex + 1),
                      {},
                      {}});
      start = vertex;
      start_node = node;
    }
  }
  graph_.DissolveDegree2Nodes();
  return std::move(graph_);
}

}  // namespace

SkeletonGraph JoinBranches(std::vector<Polyline> branches, std::vector<Vec3> junction_samples,
                           double spacing, const BranchTracingOptions& options) {
  BranchJoiner joiner(
      std::move(branches),
      ClusterJunctions(std::move(junction_samples), options.junction_link * spacing),
      options.join_reach * spacing, options.maximum_bend);
  joiner.JoinAtJunctions();
  joiner.BridgeGaps();
  joiner.JoinAtSides();
  return joiner.Build();
}

}  // namespace curvefusion
