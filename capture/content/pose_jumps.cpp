#include "capture/content/pose_jumps.h"

#include <algorithm>
#include <cmath>

#include "kernel/parallel.h"
#include "kernel/quantile.h"
#include "kernel/rigid_motion.h"

namespace curvefusion {

namespace {

constexpr int kAround = 10;        // frames to each side whose changes are typical
constexpr double kLeap = 5;        // times the typical change; then depth decides
constexpr double kMinLeap = 0.01;  // metres at the distance of the scene; chosen: a wire or two
// Chosen on fr1_rpy, whose clock is off by 20 ms: where its camera turns back, the given motion
// disagrees with depth by 16 mm and that of a neighbour by 8 mm, and it is no jump.
constexpr double kContradiction = 0.4;     // of the differences of depth
constexpr double kUnlikeOthers = 2;        // times the residual of other neighbours, median
constexpr double kLikeOthers = 1.5;        // likewise
constexpr double kSmoothResidual = 0.004;  // steady motion may err by that in any scan
constexpr int kStretchGap = 10;            // frames
constexpr int kMinStretch = 5;
// Measured: five frames in a row of good scans reach .003 to .011 (fr1_rpy .042, of a median of
// .011).
constexpr double kMinBadResidual = 0.025;
constexpr double kWorseThanMedian = 5;

// Poses and depth of neighbouring frames.
class Neighbours {
 public:
  Neighbours(const DepthViews& views, const FramePoses& poses)
      : views_(views), poses_(poses), motions_(poses.empty() ? 0 : poses.size() - 1) {
    for (size_t i = 0; i < motions_.size(); ++i) {
      if (poses[i] && poses[i + 1] && views.Has(static_cast<int>(i)) &&
          views.Has(static_cast<int>(i) + 1)) {
        motions_[i] = poses[i + 1]->inverse() * *poses[i];
      }
    }
  }

  int count() const { return static_cast<int>(motions_.size()); }
  const std::optional<RigidTransform>& motion(int i) const {
    return motions_[static_cast<size_t>(i)];
  }

  // By how much the motion differs from that of the pair before or after, whichever is more alike:
  // metres that the scene moves in the camera. Negative where it cannot be told.
  double Change(int i, double distance) const {
    double least = -1;
    for (const int other : {i - 1, i + 1}) {
      if (other < 0 || other >= count() || !motion(other) || !motion(i)) continue;
      const RigidTransform change = *motion(i) * motion(other)->inverse();
      const double size = change.translation().norm() + distance * RotationVector(change).norm();
      if (least < 0 || size < least) least = size;
    }
    return least;
  }

  PairAgreement Given(int i) const { return views_.Compare({i, i + 1}, *motion(i)); }

  // With the motion of the frames before or after, or none, whichever fits best.
  PairAgreement Smooth(int i) const {
    PairAgreement best = views_.Compare({i, i + 1}, RigidTransform::Identity());
    for (const int other : {i - 2, i - 1, i + 1, i + 2}) {
      if (other < 0 || other >= count() || !motion(other)) continue;
      const PairAgreement agreement = views_.Compare({i, i + 1}, *motion(other));
      if (agreement.is_usable && agreement.cost < best.cost) best = agreement;
    }
    return best;
  }

 private:
  const DepthViews& views_;
  const FramePoses& poses_;
  std::vector<std::optional<RigidTransform>> motions_;
};

// The median distance of some frames.
double TypicalDistance(const DepthViews& views, int frame_count) {
  std::vector<double> distances;
  for (int i = 0; i < frame_count; i += std::max(1, frame_count / 10)) {
    const DepthImage& depth = views.depth(i);
    for (size_t k = 0; k < depth.size(); k += 17) {
      if (depth.data()[k] > 0) distances.push_back(depth.data()[k]);
    }
  }
  return distances.empty() ? 1 : Median(std::move(distances));
}

double TypicalChange(const std::vector<double>& changes, int i) {
  std::vector<double> around;
  const int last = std::min(static_cast<int>(changes.size()) - 1, i + kAround);
  for (int k = std::max(0, i - kAround); k <= last; ++k) {
    if (changes[static_cast<size_t>(k)] >= 0) around.push_back(changes[static_cast<size_t>(k)]);
  }
  return Median(std::move(around));
}

// The leaps, whatever the depth says.
std::vector<int> Leaps(const Neighbours& neighbours, double distance) {
  std::vector<double> changes;
  for (int i = 0; i < neighbours.count(); ++i) {
    changes.push_back(neighbours.Change(i, distance));
  }
  std::vector<int> leaps;
  for (int i = 0; i < neighbours.count(); ++i) {
    const double change = changes[static_cast<size_t>(i)];
    if (change > kMinLeap && change > kLeap * TypicalChange(changes, i)) leaps.push_back(i);
  }
  return leaps;
}

// The median residual of some pairs of neighbours.
double TypicalResidual(const Neighbours& neighbours) {
  std::vector<double> residuals;
  for (int i = 0; i < neighbours.count(); i += std::max(1, neighbours.count() / 30)) {
    if (!neighbours.motion(i)) continue;
    const PairAgreement agreement = neighbours.Given(i);
    if (agreement.is_usable) residuals.push_back(agreement.residual);
  }
  return residuals.empty() ? 0 : Median(std::move(residuals));
}

bool Straddles(int first, int last, const std::vector<PoseJump>& jumps) {
  return std::any_of(jumps.begin(), jumps.end(), [&](const PoseJump& jump) {
    return jump.frame >= first && jump.frame < last;
  });
}

// How every frame agrees with the one kStretchGap later.
std::vector<PairAgreement> Later(const DepthViews& views, const FramePoses& poses,
                                 const std::vector<PoseJump>& jumps) {
  const int count = static_cast<int>(poses.size()) - kStretchGap;
  std::vector<PairAgreement> agreements(static_cast<size_t>(std::max(0, count)));
  ParallelFor(0, count, 8, [&](int64_t index) {
    const int i = static_cast<int>(index);
    const auto& from = poses[static_cast<size_t>(i)];
    const auto& to = poses[static_cast<size_t>(i + kStretchGap)];
    if (!from || !to || !views.Has(i) || !views.Has(i + kStretchGap)) return;
    if (Straddles(i, i + kStretchGap, jumps)) return;
    agreements[static_cast<size_t>(i)] = views.Compare({i, i + kStretchGap}, to->inverse() * *from);
  });
  return agreements;
}

BadStretch Summarize(const std::vector<PairAgreement>& agreements, int first, int last) {
  std::vector<double> residuals;
  std::vector<double> differences;
  for (int i = first; i <= last; ++i) {
    residuals.push_back(agreements[static_cast<size_t>(i)].residual);
    differences.push_back(agreements[static_cast<size_t>(i)].difference);
  }
  return {first, last + kStretchGap, Median(std::move(residuals)), Median(std::move(differences))};
}

}  // namespace

std::vector<PoseJump> FindPoseJumps(const DepthViews& views, const FramePoses& poses) {
  const Neighbours neighbours(views, poses);
  const double distance = TypicalDistance(views, static_cast<int>(poses.size()));
  const double typical = TypicalResidual(neighbours);
  std::vector<PoseJump> jumps;
  for (const int i : Leaps(neighbours, distance)) {
    const PairAgreement given = neighbours.Given(i);
    const PairAgreement smooth = neighbours.Smooth(i);
    const bool is_unlike = !given.is_usable || given.residual > kUnlikeOthers * typical;
    const bool is_alike =
        smooth.is_usable && smooth.residual < std::max(kSmoothResidual, kLikeOthers * typical);
    const bool is_contradicted =
        !given.is_usable || smooth.difference < kContradiction * given.difference;
    if (!is_unlike || !is_alike || !is_contradicted) continue;
    const RigidTransform& motion = *neighbours.motion(i);
    jumps.push_back({i, motion.translation().norm(), RotationVector(motion).norm(),
                     given.difference, smooth.difference});
  }
  return jumps;
}

std::vector<BadStretch> FindBadStretches(const DepthViews& views, const FramePoses& poses,
                                         const std::vector<PoseJump>& jumps) {
  const std::vector<PairAgreement> agreements = Later(views, poses, jumps);
  std::vector<double> residuals;
  for (const PairAgreement& agreement : agreements) {
    if (agreement.is_usable) residuals.push_back(agreement.residual);
  }
  if (residuals.empty()) return {};
  const double limit = std::max(kMinBadResidual, kWorseThanMedian * Median(std::move(residuals)));
  std::vector<BadStretch> stretches;
  const int count = static_cast<int>(agreements.size());
  for (int first = 0; first < count; ++first) {
    int end = first;
    while (end < count && agreements[static_cast<size_t>(end)].is_usable &&
           agreements[static_cast<size_t>(end)].residual > limit) {
      ++end;
    }
    if (end - first >= kMinStretch) stretches.push_back(Summarize(agreements, first, end - 1));
    first = std::max(first, end - 1);
  }
  return stretches;
}

}  // namespace curvefusion
