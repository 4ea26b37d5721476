#include "graph/contraction/branch_joining.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "kernel/dbscan.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

// Derived: indices are not negative, and a branch has two ends.
constexpr int kNone = -1;
constexpr size_t kFront = 0;
constexpr size_t kBack = 1;

// A junction lies ahead of an end when it is seen within 60 degrees of the end's heading. Chosen:
// the mean of a cluster strays from the branches' lines by about as much.
constexpr double kJunctionCosine = 0.5;

// How many vertices back the heading of an end is taken from. Chosen: the last ones may already be
// drawn into the junction.
constexpr size_t kHeadingVertices = 5;

// Chosen: what the mean of a junction's samples weighs against one branch that points past it.
// Where three and more branches meet it decides only along the branches, should those be collinear;
// where two meet, a round bend is as likely as a sharp corner, and half-way between mean and corner
// errs least.
constexpr double kMeanWeight = 0.1;
constexpr double kMeanWeightInBend = 1;

// Chosen: a loop shorter than so many times the reach is a fold of the samples in a junction: a
// ring that small would have contracted to a point.
constexpr double kLeastLoop = 3;

struct Junctions {
  std::vector<Vec3> samples;
  std::vector<int> junction_of_sample;
  std::vector<Vec3> positions;
  std::vector<int> sizes;  // numbers of samples
};

Junctions ClusterJunctions(std::vector<Vec3> samples, double link_distance) {
  Junctions junctions{std::move(samples), {}, {}, {}};
  junctions.junction_of_sample = Dbscan(junctions.samples, link_distance, 1);
  const int count = junctions.samples.empty()
                        ? 0
                        : 1 + *std::max_element(junctions.junction_of_sample.begin(),
                                                junctions.junction_of_sample.end());
  junctions.positions.assign(count, Vec3::Zero());
  junctions.sizes.assign(count, 0);
  for (size_t i = 0; i < junctions.samples.size(); ++i) {
    junctions.positions[junctions.junction_of_sample[i]] += junctions.samples[i];
    ++junctions.sizes[junctions.junction_of_sample[i]];
  }
  for (int k = 0; k < count; ++k) junctions.positions[k] /= junctions.sizes[k];
  return junctions;
}

// Where a branch ends and which way it would go on.
struct BranchEnd {
  int branch;
  bool at_front;
  Vec3 position;
  Vec3 heading;
  Vec3 tip;
  NodeId node = kNone;
};

BranchEnd EndOf(const std::vector<Branch>& branches, int branch, bool at_front) {
  const Polyline& points = branches[branch].points;
  const size_t inner = std::min(kHeadingVertices, points.size() - 1);
  const Vec3& last = at_front ? points.front() : points.back();
  const Vec3& before = at_front ? points[inner] : points[points.size() - 1 - inner];
  return {branch, at_front, last, (last - before).normalized(),
          branches[branch].tips[at_front ? 0 : 1]};
}

class BranchJoiner {
 public:
  BranchJoiner(std::vector<Branch> branches, Junctions junctions, double link, double reach,
               double maximum_bend)
      : branches_(std::move(branches)),
        junctions_(std::move(junctions)),
        junction_index_(junctions_.samples),
        is_passed_(junctions_.positions.size(), 0),
        stops_(branches_.size()),
        link_(link),
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
  struct Side {
    Vec3 position;
    int branch;  // kNone for a node
    int vertex;
    NodeId node;  // kNone for a vertex
  };
  void LookForJunction(int end);
  int LoneJunction() const;
  void PassThrough(int junction);
  Vec3 MeetingPoint(const std::vector<int>& ends, const Vec3& mean) const;
  int JunctionAhead(const BranchEnd& end);
  void Prolong(BranchEnd& end, const Vec3& position);
  bool FaceEachOther(const BranchEnd& a, const BranchEnd& b) const;
  std::vector<Gap> Gaps();
  std::vector<Side> Sides() const;
  bool IsOwnTip(const BranchEnd& end, int branch, int vertex) const;
  NodeId NodeAtVertex(int branch, int vertex);
  Polyline CurveBetweenNodes(int branch);
  NodeId& NodeAt(int branch, size_t end) {
    return ends_[2 * static_cast<size_t>(branch) + end].node;
  }
  void AddEdge(NodeId first, NodeId last, Polyline points);

  std::vector<Branch> branches_;
  Junctions junctions_;
  PointIndex junction_index_;
  std::vector<std::vector<int>> ends_at_junction_;
  std::vector<char> is_passed_;               // junctions that have become part of a branch
  std::vector<std::map<int, NodeId>> stops_;  // inner vertices of each branch that became nodes
  double link_;
  double reach_;
  double minimum_cosine_;
  std::vector<BranchEnd> ends_;  // front and back of branch b at 2 b and 2 b + 1
  std::vector<int> neighbours_;
  SkeletonGraph graph_;
};

void BranchJoiner::JoinAtJunctions() {
  ends_at_junction_.assign(junctions_.positions.size(), {});
  for (int e = 0; e < static_cast<int>(ends_.size()); ++e) LookForJunction(e);
  for (int lone = LoneJunction(); lone != kNone; lone = LoneJunction()) PassThrough(lone);
  for (size_t k = 0; k < ends_at_junction_.size(); ++k) {
    if (ends_at_junction_[k].empty()) continue;
    const NodeId node = graph_.AddNode(MeetingPoint(ends_at_junction_[k], junctions_.positions[k]));
    for (const int e : ends_at_junction_[k]) ends_[e].node = node;
  }
}

void BranchJoiner::LookForJunction(int end) {
  const int junction = JunctionAhead(ends_[end]);
  if (junction != kNone) ends_at_junction_[junction].push_back(end);
}

// The smallest junction that only one branch runs up to: it joins nothing.
int BranchJoiner::LoneJunction() const {
  int smallest = kNone;
  for (int k = 0; k < static_cast<int>(ends_at_junction_.size()); ++k) {
    if (ends_at_junction_[k].size() != 1) continue;
    if (smallest == kNone || junctions_.sizes[k] < junctions_.sizes[smallest]) smallest = k;
  }
  return smallest;
}

// The point nearest to the lines that the ends head along, unless it lies behind an end.
// Contraction draws the samples of a corner to its inside, by 4 mm for the paper's radius; the
// branches still point at the corner itself.
Vec3 BranchJoiner::MeetingPoint(const std::vector<int>& ends, const Vec3& mean) const {
  const double mean_weight = ends.size() == 2 ? kMeanWeightInBend : kMeanWeight;
  Mat3 normal = mean_weight * Mat3::Identity();
  Vec3 right = mean_weight * mean;
  for (const int e : ends) {
    const Mat3 across = Mat3::Identity() - ends_[e].heading * ends_[e].heading.transpose();
    normal += across;
    right += across * ends_[e].position;
  }
  const Vec3 meeting = normal.ldlt().solve(right);
  const bool is_ahead = std::all_of(ends.begin(), ends.end(), [&](int e) {
    return (meeting - ends_[e].position).dot(ends_[e].heading) >= -link_;
  });
  return is_ahead && (meeting - mean).norm() <= reach_ ? meeting : mean;
}

// Makes a lone junction part of its branch, which then looks ahead again.
void BranchJoiner::PassThrough(int junction) {
  const int end = ends_at_junction_[junction].front();
  ends_at_junction_[junction].clear();
  is_passed_[junction] = 1;
  const Vec3 step = junctions_.positions[junction] - ends_[end].position;
  if (step.dot(ends_[end].heading) >= kJunctionCosine * step.norm())
    Prolong(ends_[end], junctions_.positions[junction]);
  LookForJunction(end);
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
    const bool is_ahead = to_center.dot(end.heading) >= kJunctionCosine * to_center.norm();
    if (!is_ahead && distance > link_) continue;
    nearest = junction;
    nearest_distance = distance;
  }
  return nearest;
}

void BranchJoiner::Prolong(BranchEnd& end, const Vec3& position) {
  if (position == end.position) return;
  Polyline& points = branches_[end.branch].points;
  points.insert(end.at_front ? points.begin() : points.end(), position);
  branches_[end.branch].tips[end.at_front ? 0 : 1] = position;
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
  const Polyline& points = branches_[branch].points;
  const int tip = end.at_front ? 0 : static_cast<int>(points.size()) - 1;
  double length = 0;
  for (int i = std::min(vertex, tip); i < std::max(vertex, tip); ++i)
    length += (points[i + 1] - points[i]).norm();
  return length < 2 * reach_;
}

NodeId BranchJoiner::NodeAtVertex(int branch, int vertex) {
  const Polyline& points = branches_[branch].points;
  const bool is_front = vertex == 0;
  const bool is_back = vertex + 1 == static_cast<int>(points.size());
  NodeId& node = is_front  ? NodeAt(branch, kFront)
                 : is_back ? NodeAt(branch, kBack)
                           : stops_[branch].try_emplace(vertex, kNone).first->second;
  if (node == kNone) node = graph_.AddNode(points[vertex]);
  return node;
}

// The vertices of all branches, and the nodes made so far.
std::vector<BranchJoiner::Side> BranchJoiner::Sides() const {
  std::vector<Side> sides;
  for (const NodeId node : graph_.Nodes())
    sides.push_back({graph_.position(node), kNone, kNone, node});
  for (int b = 0; b < static_cast<int>(branches_.size()); ++b) {
    for (int v = 0; v < static_cast<int>(branches_[b].points.size()); ++v)
      sides.push_back({branches_[b].points[v], b, v, kNone});
  }
  return sides;
}

void BranchJoiner::JoinAtSides() {
  const std::vector<Side> sides = Sides();
  std::vector<Vec3> positions;
  positions.reserve(sides.size());
  for (const Side& side : sides) positions.push_back(side.position);
  const PointIndex index(positions);
  for (BranchEnd& end : ends_) {
    if (end.node != kNone) continue;
    index.WithinRadius(end.position, reach_, neighbours_);
    const Side* nearest = nullptr;
    double nearest_distance = std::numeric_limits<double>::infinity();
    for (const int i : neighbours_) {
      const Vec3 step = positions[i] - end.position;
      const double distance = step.norm();
      if (distance >= nearest_distance || step.dot(end.heading) <= minimum_cosine_ * distance)
        continue;
      if (IsOwnTip(end, sides[i].branch, sides[i].vertex)) continue;
      nearest = &sides[i];
      nearest_distance = distance;
    }
    if (nearest == nullptr) continue;
    end.node =
        nearest->node != kNone ? nearest->node : NodeAtVertex(nearest->branch, nearest->vertex);
  }
}

// The branch with the positions of its end nodes, where those lie beyond it.
Polyline BranchJoiner::CurveBetweenNodes(int branch) {
  Polyline curve = branches_[branch].points;
  const Vec3& first = graph_.position(NodeAt(branch, kFront));
  const Vec3& last = graph_.position(NodeAt(branch, kBack));
  if (first != curve.front()) curve.insert(curve.begin(), first);
  if (last != curve.back()) curve.push_back(last);
  return curve;
}

void BranchJoiner::AddEdge(NodeId first, NodeId last, Polyline points) {
  if (first == last && Length(points) < kLeastLoop * reach_) return;
  graph_.AddEdge({{first, last}, std::move(points), {}, {}});
}

SkeletonGraph BranchJoiner::Build() {
  for (BranchEnd& end : ends_) {
    if (end.node == kNone) end.node = graph_.AddNode(end.tip);
  }
  for (int b = 0; b < static_cast<int>(branches_.size()); ++b) {
    const Polyline curve = CurveBetweenNodes(b);
    const int shift = curve[0] == branches_[b].points[0] ? 0 : 1;
    std::map<int, NodeId> stops;
    for (const auto& [vertex, node] : stops_[b]) stops[vertex + shift] = node;
    stops[static_cast<int>(curve.size()) - 1] = NodeAt(b, kBack);
    int start = 0;
    NodeId start_node = NodeAt(b, kFront);
    for (const auto& [vertex, node] : stops) {
      AddEdge(start_node, node, Polyline(curve.begin() + start, curve.begin() + vertex + 1));
      start = vertex;
      start_node = node;
    }
  }
  graph_.RemoveIsolatedNodes();
  graph_.DissolveDegree2Nodes();
  return std::move(graph_);
}

}  // namespace

SkeletonGraph JoinBranches(std::vector<Branch> branches, std::vector<Vec3> junction_samples,
                           double spacing, const BranchTracingOptions& options) {
  const double link = options.junction_link * spacing;
  BranchJoiner joiner(std::move(branches), ClusterJunctions(std::move(junction_samples), link),
                      link, options.join_reach * spacing, options.maximum_bend);
  joiner.JoinAtJunctions();
  joiner.BridgeGaps();
  joiner.JoinAtSides();
  return joiner.Build();
}

}  // namespace curvefusion
