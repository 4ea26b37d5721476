#include "capture/content/clock_search.h"

#include <algorithm>
#include <cmath>

#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr double kWindow = 2;           // seconds around the offset that makes the ends meet
constexpr double kStep = 1;             // frames; 3 lie inside the basin of the right offset
constexpr double kMaxResidual = 0.015;  // as there are no given poses to compare with
constexpr double kBetterThanOthers = 0.7;
constexpr double kFinest = 0.002;  // seconds
constexpr int kMinUsablePairs = 8;

double FrameStep(const MisfitEvidence& evidence) { return kStep * evidence.frame_period; }

// Offsets at which both beginnings, or both ends, are near.
std::vector<double> Offsets(const MisfitEvidence& evidence) {
  std::vector<double> offsets;
  const auto add_around = [&](double middle) {
    for (double shift = -kWindow; shift <= kWindow; shift += FrameStep(evidence)) {
      offsets.push_back(middle + shift);
    }
  };
  add_around(evidence.trajectory.front().timestamp - evidence.times.front());
  add_around(evidence.trajectory.back().timestamp - evidence.times.back());
  return offsets;
}

}  // namespace

std::optional<PoseSearch> FindDistantClock(const MisfitEvidence& evidence) {
  if (evidence.trajectory.empty() || evidence.times.empty()) return std::nullopt;
  const DepthViews views(evidence.thumbnails, evidence.depth_scale);
  std::optional<PoseExplanation> best;
  std::vector<double> costs;
  const auto consider = [&](double offset) {
    FramePoses poses = PosesAt(evidence.trajectory, evidence.times, offset);
    PoseAgreement agreement = MeasureAgreement(views, evidence.pairs, poses);
    if (agreement.usable <
        std::max<int>(kMinUsablePairs, static_cast<int>(evidence.pairs.size()) / 3)) {
      return;
    }
    costs.push_back(agreement.cost);
    if (best && best->agreement.cost <= agreement.cost) return;
    best =
        PoseExplanation{"clock-offset", "", std::move(poses), false, offset, std::move(agreement)};
  };
  for (const double offset : Offsets(evidence)) consider(offset);
  if (!best) return std::nullopt;
  const double typical = Median(costs);
  for (double step = FrameStep(evidence) / 2; step > kFinest; step /= 2) {
    const double offset = best->value;
    consider(offset - step);
    consider(offset + step);
  }
  if (best->agreement.residual > kMaxResidual ||
      best->agreement.cost > kBetterThanOthers * typical) {
    return std::nullopt;
  }
  return PoseSearch{{}, std::move(best)};
}

}  // namespace curvefusion
