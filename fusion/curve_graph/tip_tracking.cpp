#include "fusion/curve_graph/tip_tracking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "graph/sampled_curves.h"
#include "kernel/parallel.h"
#include "kernel/point_grid.h"
#include "kernel/polyline.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Scores are logarithms of how much likelier the strips are for a wire than by chance, less what
// wires and bends cost beforehand. Chosen while looking at training scans furnished 1, rack 2,
// tree 2, umbrella 1 and vine 1 (docs/lab_notebook.md).
constexpr double kStep = 0.003;              // metres
constexpr double kCorrelationLength = 0.01;  // metres; strips nearer to each other tell the same
constexpr double kShare = kStep / kCorrelationLength;  // derived: of what a place tells
constexpr double kCost = 1;                            // of wire, a correlation length
constexpr double kBlindCost = 0.2;                     // likewise, where no image can tell
constexpr double kManyLooks = 15;                      // images; so many tell
constexpr double kNotFree = -3;                        // where depth shows nothing behind
constexpr double kBendCost = 2;                        // of the largest bend, a correlation length
constexpr double kMaxBend = 0.2;                       // radians in a step: a radius of 15 mm
constexpr double kFirstStep = 0.006;  // metres; strips are not told beside known curves
constexpr double kFirstBend = 0.6;    // radians; ends of curves lie beside their wires
constexpr size_t kBeam = 12;          // paths followed at a time
constexpr double kMaxDrop = 3;        // below the best of a path so far
constexpr double kMinScore = 4;       // 98 %, as far as the scores can be believed
constexpr double kMaxLength = 1;      // metres
constexpr double kFaded = 0.75;       // of the usual share of images that show a wire
constexpr size_t kSettled = 4;        // places that tell what is usual
constexpr double kFitLength = 0.015;  // metres, that tell the direction of an end
constexpr double kBeside = 0.004;     // metres; nearer to another curve a path is that curve
constexpr double kOwn = 0.012;        // metres of path that may lie beside the curve it starts from

// A direction next to the z axis, and its angle over the largest one.
struct Bend {
  Vec3 direction;
  double share;
};

// Straight on and two rings around it.
constexpr int kRings = 2, kSides = 6;
using Bends = std::array<Bend, 1 + kRings * kSides>;

Bends BendsUpTo(double most) {
  Bends bends;
  bends[0] = {Vec3::UnitZ(), 0};
  for (int i = 0; i < kRings * kSides; ++i) {
    const int ring = i / kSides;
    const double share = (ring + 1.0) / kRings;
    const double turn = 2 * M_PI * (i + 0.5 * ring) / kSides;
    const double across = std::sin(most * share);
    bends[i + 1] = {Vec3(across * std::cos(turn), across * std::sin(turn), std::cos(most * share)),
                    share};
  }
  return bends;
}

// An end of a path.
struct Place {
  Vec3 position;
  Vec3 direction;
  double score = 0;
  int before = -1;
  int steps = 0;
};

class TipTracker {
 public:
  // Places on known curves are so dense that no curve is passed by.
  TipTracker(const StripViews& views, const SkeletonGraph& skeleton)
      : views_(views), known_(SampleCurvesOf(skeleton, 0.5 * kBeside).positions, kBeside) {}

  // The path from an end as far as images show it; empty where they do not.
  Polyline Follow(const Vec3& start, const Vec3& direction) const {
    std::vector<Place> places = {{start, direction}};
    std::vector<int> beam = {0};
    int best = 0;
    for (int step = 1; step * kStep < kMaxLength; ++step) {
      beam = Next(beam, places);
      if (beam.empty() || places[beam[0]].score < places[best].score - kMaxDrop) break;
      if (places[beam[0]].score > places[best].score) best = beam[0];
    }
    if (places[best].score < kMinScore) return {};
    Polyline path;
    for (int at = best; at >= 0; at = places[at].before) path.push_back(places[at].position);
    std::reverse(path.begin(), path.end());
    CutWhereItFades(path);
    return path;
  }

 private:
  // A wire ends where much fewer images show it than before: what goes on is something else.
  void CutWhereItFades(Polyline& path) const {
    std::vector<double> shares;
    for (size_t i = 1; i < path.size(); ++i) {
      const StripAgreement look = views_.Along(path[i], (path[i] - path[i - 1]).normalized());
      const double share = look.looked > 0 ? static_cast<double>(look.seen) / look.looked : 0;
      if (look.looked >= kManyLooks) shares.push_back(share);
      if (shares.size() < kSettled || share >= kFaded * Median(shares)) continue;
      path.resize(i);
      return;
    }
  }

  double Gain(const Vec3& p, const Vec3& direction, double bend) const {
    const StripAgreement look = views_.Along(p, direction);
    double evidence = look.Sum();
    if (!views_.IsFree(p)) evidence = std::min(evidence, kNotFree);
    const double told = std::min(1.0, look.looked / kManyLooks);
    const double cost = kBlindCost + (kCost - kBlindCost) * told + kBendCost * bend * bend;
    return kShare * (evidence - cost);
  }

  // The best ends a step farther.
  std::vector<int> Next(const std::vector<int>& beam, std::vector<Place>& places) const {
    std::vector<Place> next(beam.size() * bends_.size());
    ParallelFor(0, static_cast<int64_t>(next.size()), 8, [&](int64_t i) {
      const int before = beam[i / bends_.size()];
      const Place& from = places[before];
      const bool is_first = from.before < 0;
      const Bend& bend = (is_first ? first_bends_ : bends_)[i % bends_.size()];
      const Vec3 direction =
          Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), from.direction) * bend.direction;
      const Vec3 p = from.position + (is_first ? kFirstStep : kStep) * direction;
      next[i] = {p, is_first ? from.direction : direction,
                 from.score + Gain(p, is_first ? from.direction : direction, bend.share), before,
                 from.steps + 1};
    });
    std::stable_sort(next.begin(), next.end(),
                     [](const Place& a, const Place& b) { return a.score > b.score; });
    std::vector<int> kept;
    for (const Place& place : next) {
      if (kept.size() == kBeam) break;
      if (HasArrived(places[place.before])) continue;
      const bool is_known = std::any_of(kept.begin(), kept.end(), [&](int at) {
        return (places[at].position - place.position).norm() < 0.2 * kStep;
      });
      if (is_known) continue;
      kept.push_back(static_cast<int>(places.size()));
      places.push_back(place);
    }
    return kept;
  }

  bool HasArrived(const Place& place) const {
    return place.steps * kStep > kOwn && known_.Nearest(place.position, kBeside) >= 0;
  }

  const StripViews& views_;
  Bends bends_ = BendsUpTo(kMaxBend);
  Bends first_bends_ = BendsUpTo(kFirstBend);
  PointGrid known_;
};

// Directions of steps are few: what they zigzag by goes, the ends stay.
void Smooth(Polyline& path) {
  constexpr int kRounds = 4;  // chosen: 5 mm along the path
  for (int round = 0; round < kRounds; ++round) {
    Vec3 before = path[0];
    for (size_t i = 1; i + 1 < path.size(); ++i) {
      const Vec3 smooth = 0.25 * before + 0.5 * path[i] + 0.25 * path[i + 1];
      before = path[i];
      path[i] = smooth;
    }
  }
}

// Where a curve that ends at a node would go on; zero where it is too short to tell.
Vec3 DirectionAt(const SkeletonGraph& skeleton, NodeId node) {
  const SkeletonEdge& edge = skeleton.edge(skeleton.IncidentEdges(node)[0]);
  Polyline points = edge.points;
  if (edge.nodes[0] == node) std::reverse(points.begin(), points.end());
  const std::vector<double> arc = CumulativeLength(points);
  const Vec3 back = PointAt(points, arc, std::max(0.0, arc.back() - kFitLength));
  const Vec3 ahead = points.back() - back;
  return ahead.norm() < kStep ? Vec3::Zero() : ahead.normalized();
}

}  // namespace

double TrackTips(double radius, StripViews& views, SkeletonGraph& skeleton) {
  double length = 0;
  std::optional<TipTracker> tracker;  // that knows all curves
  for (const NodeId node : skeleton.Nodes()) {
    if (skeleton.Degree(node) != 1) continue;
    const Vec3 direction = DirectionAt(skeleton, node);
    if (direction == Vec3::Zero()) continue;
    if (!tracker) tracker.emplace(views, skeleton);
    Polyline path = tracker->Follow(skeleton.position(node), direction);
    if (path.size() < 2) continue;
    Smooth(path);
    const std::vector<double> radii(path.size(), radius);
    views.Explain(path, radii);
    skeleton.AddEdge({{node, skeleton.AddNode(path.back())}, path, radii, {}});
    length += Length(path);
    tracker.reset();
  }
  if (length > 0) skeleton.DissolveDegree2Nodes();
  return length;
}

}  // namespace curvefusion
