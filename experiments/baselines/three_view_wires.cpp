#include "experiments/baselines/three_view_wires.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "experiments/baselines/curve_candidates.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

// The angle that three lines 60 degrees apart from each other can all keep from the horizontal and
// the vertical.
constexpr double kOffHorizontal = std::numbers::pi / 12;

// Points at the end of a curve over which its direction is taken: as in the authors' program.
constexpr size_t kEndPoints = 5;

// An end of a curve and the unit direction in which it goes on.
struct CurveEnd {
  Vec3 position;
  Vec3 outward;
};

CurveEnd BackOf(const Polyline& points) {
  const size_t back = points.size() - 1;
  const Vec3 along = points[back] - points[back - std::min(kEndPoints, back)];
  return {points[back], along.norm() > 0 ? along.normalized() : Vec3::Zero()};
}

std::vector<CurveEnd> EndsOf(const Polyline& points) {
  return {BackOf(points), BackOf({points.rbegin(), points.rend()})};
}

class Selection {
 public:
  Selection(const std::vector<CurveView>& views, const std::vector<CurveCandidate>& candidates)
      : candidates_(candidates) {
    for (const CurveView& view : views) is_covered_.emplace_back(view.curves.size(), 0);
  }

  std::vector<Polyline> Select(const Progress& progress) {
    while (true) {
      progress("selection", static_cast<int64_t>(selected_.size()),
               static_cast<int64_t>(candidates_.size()));
      Run best;
      double best_value = 0;
      for (const CurveCandidate& candidate : candidates_) {
        const Run run = LongestNewRun(candidate);
        const auto pixels = static_cast<double>(run.points.size());
        if (pixels <= std::max<double>(kLeastCurvePixels, best_value)) continue;
        const double value = pixels / (1 + candidate.distance_px + CostOfJoin(run.points));
        if (value <= best_value) continue;
        best = run;
        best_value = value;
      }
      if (best.points.empty()) return selected_;
      Add(best);
    }
  }

 private:
  // A part of a candidate: its points, and its pixels from first to last.
  struct Run {
    Polyline points;
    int view = 0, first = 0, last = 0;
  };

  // The longest part of a candidate whose pixels nothing covers.
  Run LongestNewRun(const CurveCandidate& candidate) const {
    size_t begin = 0, best_begin = 0, best_end = 0;
    for (size_t i = 0; i < candidate.pixels.size(); ++i) {
      if (is_covered_[candidate.view][candidate.pixels[i]]) {
        begin = i + 1;
      } else if (i + 1 - begin > best_end - best_begin) {
        best_begin = begin;
        best_end = i + 1;
      }
    }
    if (best_end == 0) return {};
    const auto points = candidate.points.begin();
    return {{points + static_cast<std::ptrdiff_t>(best_begin),
             points + static_cast<std::ptrdiff_t>(best_end)},
            candidate.view,
            candidate.pixels[best_begin],
            candidate.pixels[best_end - 1]};
  }

  // How far from the others' ends its nearer end is, in its lengths, and how sharp the turn there.
  double CostOfJoin(const Polyline& points) const {
    const double length = Length(points);
    double gap = selected_.empty() ? 0 : length;
    double turn = 0;
    for (const CurveEnd& end : EndsOf(points)) {
      for (const CurveEnd& other : ends_) {
        const double distance = (other.position - end.position).norm();
        if (distance >= gap) continue;
        gap = distance;
        turn = (1 + end.outward.dot(other.outward)) / 2;  // 0 where they point at each other
      }
    }
    return (length > 0 ? gap / length : 1) + turn;
  }

  // Covers its gaps, too, so that nothing is put into them.
  void Add(const Run& run) {
    const auto covered = is_covered_[run.view].begin();
    std::fill(covered + run.first, covered + run.last + 1, 1);
    selected_.push_back(run.points);
    for (const CurveEnd& end : EndsOf(run.points)) ends_.push_back(end);
  }

  const std::vector<CurveCandidate>& candidates_;
  std::vector<std::vector<char>> is_covered_;  // pixels of the curves of each image
  std::vector<Polyline> selected_;
  std::vector<CurveEnd> ends_;
};

}  // namespace

std::vector<RigidTransform> ThreePosesAround(const Vec3& center, const Vec3& away, double distance,
                                             double angle) {
  // cos(angle) = 1 - 1.5 sin^2(from the middle) for directions 120 degrees apart around it.
  const double sine = std::sqrt((1 - std::cos(angle)) / 1.5);
  const Vec3 right =
      std::abs(away.z()) < 1 ? Vec3::UnitZ().cross(away).normalized() : Vec3::UnitX();
  const Vec3 up = away.cross(right);
  std::vector<RigidTransform> poses;
  for (int i = 0; i < 3; ++i) {
    const double around = kOffHorizontal + 2 * std::numbers::pi * i / 3;
    const Vec3 aside = std::cos(around) * right + std::sin(around) * up;
    poses.push_back(
        PoseTowards(center, std::sqrt(1 - sine * sine) * away + sine * aside, distance));
  }
  return poses;
}

ThreeViewWires WiresOfThreeViews(const std::vector<SilhouetteMap>& views, SupportRule rule,
                                 const Progress& progress) {
  if (views.size() != 3) {
    throw Error(ErrorKind::kBadInput, "Wires are found in three views, and " +
                                          std::to_string(views.size()) +
                                          " are given: give three images with their poses.");
  }
  std::vector<CurveView> curve_views;
  for (const SilhouetteMap& view : views) {
    progress("image curves", static_cast<int64_t>(curve_views.size()), 3);
    curve_views.push_back(FindImageCurves(view));
  }
  const std::vector<CurveCandidate> candidates = SupportedCandidates(curve_views, rule, progress);
  ThreeViewWires wires;
  for (const CurveCandidate& candidate : candidates) wires.candidates.AddPolyline(candidate.points);
  for (const Polyline& points : Selection(curve_views, candidates).Select(progress)) {
    wires.selected.AddPolyline(points);
  }
  return wires;
}

}  // namespace curvefusion
