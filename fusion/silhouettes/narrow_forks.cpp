#include "fusion/silhouettes/narrow_forks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "graph/edge_parts.h"
#include "kernel/parallel.h"
#include "kernel/point_grid.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr double kSampling = 0.0015;  // metres
constexpr double kMinLength = 0.10;   // metres; from the tip to where both wires are told apart
constexpr double kMaxLength = 0.24;
constexpr double kLengthStep = 0.02;
constexpr double kMinAngle = 0.07;  // radians
constexpr double kMaxAngle = 0.3;
constexpr double kTail = 0.04;        // metres; of the wire, which points at the tip
constexpr double kOnCurve = 0.005;    // metres; depth draws wires so far beside their place
constexpr double kOffCurve = 0.0025;  // metres
constexpr double kMinOff = 0.35;      // of a way, where no curve follows it
constexpr double kMinShare = 0.97;
constexpr double kBeyond = 0.025;    // metres ahead of the tip, where nothing goes on
constexpr double kBeside = 0.006;    // metres beside the ways; what lies so near runs between them
constexpr double kMinPiece = 0.012;  // metres; the shortest spur
constexpr double kStep = 0.003;      // metres

// Places along all curves, with the radii of their edges.
struct CurveSamples {
  std::vector<Vec3> positions;
  std::vector<double> radii;
};

CurveSamples SampleCurves(const SkeletonGraph& skeleton) {
  CurveSamples samples;
  for (const EdgeId id : skeleton.Edges()) {
    const Polyline points = Resample(skeleton.edge(id).points, kSampling);
    samples.positions.insert(samples.positions.end(), points.begin(), points.end());
    samples.radii.resize(samples.positions.size(), Median(skeleton.edge(id).radii));
  }
  return samples;
}

// One of two wires, from where it is told from the other straight to the tip.
struct Strand {
  Vec3 direction;    ///< unit, away from the tip
  double radius;     ///< metres
  double deviation;  ///< metres from the way to the wire beyond it, on average
};

struct NarrowFork {
  NodeId node = -1;
  Vec3 tip;
  double length = 0;
  std::array<Strand, 2> strands;

  double deviation() const { return strands[0].deviation + strands[1].deviation; }
  Vec3 axis() const { return (strands[0].direction + strands[1].direction).normalized(); }
};

// Looks for forks in a skeleton that stays as it is.
class ForkSearch {
 public:
  ForkSearch(const WireSilhouettes& silhouettes, const SkeletonGraph& skeleton)
      : silhouettes_(silhouettes),
        skeleton_(skeleton),
        samples_(SampleCurves(skeleton)),
        grid_(samples_.positions, kOnCurve) {}

  // Of the forks with their tip at a node the one whose wires point there best.
  std::optional<NarrowFork> ForkAt(NodeId node) const {
    std::optional<NarrowFork> best;
    if (skeleton_.Degree(node) != 2) return best;
    const Vec3& tip = skeleton_.position(node);
    for (const auto& [length, shell] : Shells(tip)) {
      const std::vector<Strand> strands = Strands(tip, length, shell);
      for (size_t i = 0; i < strands.size(); ++i) {
        for (size_t j = i + 1; j < strands.size(); ++j) {
          const NarrowFork fork{node, tip, length, {strands[i], strands[j]}};
          if (best && fork.deviation() >= best->deviation()) continue;
          if (IsApart(fork) && !GoesOn(fork)) best = fork;
        }
      }
    }
    return best;
  }

 private:
  struct Shell {
    double length;
    std::vector<int> samples;
  };

  // The samples at each distance from a tip, the nearest first.
  std::vector<Shell> Shells(const Vec3& tip) const {
    std::vector<Shell> shells;
    for (double length = kMinLength; length <= kMaxLength + kSampling; length += kLengthStep)
      shells.push_back({length, {}});
    for (size_t i = 0; i < samples_.positions.size(); ++i) {
      const double place = ((samples_.positions[i] - tip).norm() - kMinLength) / kLengthStep;
      const double nearest = std::round(place);
      if (nearest < 0 || nearest >= static_cast<double>(shells.size())) continue;
      if (std::abs(place - nearest) * kLengthStep > 0.55 * kSampling) continue;
      shells[static_cast<size_t>(nearest)].samples.push_back(static_cast<int>(i));
    }
    return shells;
  }

  bool IsNear(const Vec3& p, double distance) const { return grid_.Nearest(p, distance) >= 0; }

  // The wires that point at the tip from a distance on, along ways that no curve follows.
  std::vector<Strand> Strands(const Vec3& tip, double length, const std::vector<int>& shell) const {
    std::vector<Strand> strands;
    for (const int i : shell) {
      const Vec3 direction = (samples_.positions[i] - tip).normalized();
      const std::optional<double> deviation = DeviationBeyond(tip, direction, length);
      if (deviation && IsUnfollowed(tip, direction, length) && IsWire(tip, direction, length))
        strands.push_back({direction, samples_.radii[i], *deviation});
    }
    return strands;
  }

  // How far a curve lies on average from a straight way that goes on beyond its length; nothing
  // where none goes on.
  std::optional<double> DeviationBeyond(const Vec3& tip, const Vec3& direction,
                                        double length) const {
    double sum = 0;
    int count = 0;
    for (double s = length + kStep; s < length + kTail; s += kStep, ++count) {
      const Vec3 p = tip + s * direction;
      const int nearest = grid_.Nearest(p, kOnCurve);
      if (nearest < 0) return std::nullopt;
      sum += (samples_.positions[nearest] - p).norm();
    }
    return sum / count;
  }

  bool IsUnfollowed(const Vec3& tip, const Vec3& direction, double length) const {
    int off = 0, all = 0;
    for (double s = kMinPiece; s < length - 2 * kStep; s += kStep, ++all)
      off += IsNear(tip + s * direction, kOffCurve) ? 0 : 1;
    return off >= kMinOff * all;
  }

  bool IsWire(const Vec3& tip, const Vec3& direction, double length) const {
    for (double s = kMinPiece; s < length; s += kStep)
      if (silhouettes_.Share(tip + s * direction) < kMinShare) return false;
    return true;
  }

  static bool IsApart(const NarrowFork& fork) {
    const auto& [a, b] = fork.strands;
    const double angle = std::acos(std::min(1.0, a.direction.dot(b.direction)));
    return angle > kMinAngle && angle < kMaxAngle &&
           angle * fork.length > a.radius + b.radius + kStep;
  }

  bool GoesOn(const NarrowFork& fork) const {
    for (double s = kMinPiece; s <= kBeyond; s += kStep)
      if (IsNear(fork.tip - s * fork.axis(), kBeside)) return true;
    return false;
  }

  const WireSilhouettes& silhouettes_;
  const SkeletonGraph& skeleton_;
  CurveSamples samples_;
  PointGrid grid_;
};

// Whether a place lies between the ways of both wires, or little beside.
bool IsBetween(const NarrowFork& fork, const Vec3& p) {
  const Vec3 axis = fork.axis();
  const double height = axis.dot(p - fork.tip);
  const double reach = fork.length * axis.dot(fork.strands[0].direction);
  if (height < kStep || height > reach - kStep) return false;
  std::array<Vec3, 2> ends;
  for (size_t i = 0; i < 2; ++i) {
    const Vec3& direction = fork.strands[i].direction;
    ends[i] = fork.tip + height / axis.dot(direction) * direction;
  }
  const double t = ClosestParameter(ends[0], ends[1], p);
  return (ends[0] + t * (ends[1] - ends[0]) - p).norm() <= kBeside;
}

// The fork whose wires point at its tip best. Where others cross the wires before they meet, there
// seem to be forks too.
std::optional<NarrowFork> BestFork(const WireSilhouettes& silhouettes,
                                   const SkeletonGraph& skeleton) {
  const ForkSearch search(silhouettes, skeleton);
  const std::vector<NodeId> nodes = skeleton.Nodes();
  std::vector<std::optional<NarrowFork>> found(nodes.size());
  ParallelFor(0, static_cast<int64_t>(nodes.size()), 1,
              [&](int64_t i) { found[i] = search.ForkAt(nodes[i]); });
  std::erase_if(found, [](const auto& fork) { return !fork; });
  std::optional<NarrowFork> best;
  for (const auto& fork : found) {
    if (best && best->deviation() <= fork->deviation()) continue;
    if (std::none_of(found.begin(), found.end(),
                     [&](const auto& other) { return IsBetween(*other, fork->tip); }))
      best = fork;
  }
  return best;
}

// The node at the point of all curves next to a place; an edge is split where there is none.
NodeId NodeNextTo(const Vec3& place, SkeletonGraph& skeleton) {
  EdgeId nearest = -1;
  size_t index = 0;
  double least = 0;
  for (const EdgeId id : skeleton.Edges()) {
    const Polyline& points = skeleton.edge(id).points;
    for (size_t i = 0; i < points.size(); ++i) {
      const double distance = (points[i] - place).squaredNorm();
      if (nearest >= 0 && distance >= least) continue;
      nearest = id, index = i, least = distance;
    }
  }
  const SkeletonEdge& edge = skeleton.edge(nearest);
  if (index == 0) return edge.nodes[0];
  if (index + 1 == edge.points.size()) return edge.nodes[1];
  return skeleton.SplitEdge(nearest, index);
}

void RemoveBetween(const NarrowFork& fork, SkeletonGraph& skeleton) {
  for (const EdgeId id : skeleton.Edges()) {
    const Polyline& points = skeleton.edge(id).points;
    std::vector<EdgePart> parts;
    bool is_cut = false;
    for (size_t i = 0; i < points.size(); ++i) {
      if (IsBetween(fork, points[i])) {
        is_cut = true;
      } else if (!parts.empty() && parts.back().last + 1 == i) {
        parts.back().last = i;
      } else {
        parts.push_back({i, i});
      }
    }
    if (is_cut) KeepParts(id, parts, kMinPiece, skeleton);
  }
}

void Part(const NarrowFork& fork, SkeletonGraph& skeleton) {
  std::array<NodeId, 2> ends;
  for (size_t i = 0; i < 2; ++i)
    ends[i] = NodeNextTo(fork.tip + fork.length * fork.strands[i].direction, skeleton);
  RemoveBetween(fork, skeleton);
  for (size_t i = 0; i < 2; ++i) {
    Polyline way = Resample({skeleton.position(ends[i]), fork.tip}, kStep);
    std::vector<double> radii(way.size(), fork.strands[i].radius);
    skeleton.AddEdge({{ends[i], fork.node}, std::move(way), std::move(radii), {}});
  }
  skeleton.RemoveIsolatedNodes();
}

}  // namespace

int PartNarrowForks(const WireSilhouettes& silhouettes, SkeletonGraph& skeleton) {
  constexpr int kMaxForks = 100;
  int count = 0;
  while (count < kMaxForks) {
    const std::optional<NarrowFork> fork = BestFork(silhouettes, skeleton);
    if (!fork) break;
    Part(*fork, skeleton);
    ++count;
  }
  return count;
}

}  // namespace curvefusion
