#include "capture/content/pose_jumps.h"

#include <algorithm>
#include <array>
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
// Chosen on training scans of 5 frames a second, whose motion differs by more from frame to frame
// than a jump of 40 mm and 2 degrees (residual .03 to .07 of the distance).
constexpr double kMinCutResidual = 0.015;             // of the distance, across a cut
constexpr double kCut = 4;                            // times that of neighbours, median
constexpr double kAgreed = 0.6;                       // of the above, at most, on both sides
constexpr std::array<int, 2> kStretchGaps = {5, 10};  // frames
constexpr int kMinStretch = 5;
// Measured: five frames in a row of good scans reach .003 to .011 (fr1_rpy .042, of a median of
// .011).
constexpr double kMinBadResidual = 0.025;
constexpr double kWorseThanTypical = 5;
// Chosen: of the residuals; in a scan of 40 frames with 10 bad ones nearly half of all pairs are
// bad.
constexpr double kTypical = 0.4;

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

  // Of any two frames; not usable where one is missing.
  PairAgreement Between(int from, int to) const {
    if (from < 0 || to > count()) return {};
    const auto& a = poses_[static_cast<size_t>(from)];
    const auto& b = poses_[static_cast<size_t>(to)];
    if (!a || !b || !views_.Has(from) || !views_.Has(to)) return {};
    return views_.Compare({from, to}, b->inverse() * *a);
  }

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

// Medians over some pairs of neighbours.
PairAgreement TypicalAgreement(const Neighbours& neighbours) {
  std::vector<double> residuals;
  std::vector<double> differences;
  for (int i = 0; i < neighbours.count(); i += std::max(1, neighbours.count() / 30)) {
    if (!neighbours.motion(i)) continue;
    const PairAgreement agreement = neighbours.Given(i);
    if (!agreement.is_usable) continue;
    residuals.push_back(agreement.residual);
    differences.push_back(agreement.difference);
  }
  PairAgreement typical;
  if (residuals.empty()) return typical;
  typical.residual = Median(std::move(residuals));
  typical.difference = Median(std::move(differences));
  return typical;
}

bool IsAgreed(const PairAgreement& pair, double limit) {
  return pair.is_usable && pair.residual < limit;
}

bool IsContradicted(const PairAgreement& pair, double limit) {
  return pair.is_usable && pair.residual > limit;
}

// Whether depth disagrees between frames i and i + 1, and also over two frames across that place
// (or else one of both frames is off, so that those around it agree), while it agrees on both
// sides.
bool IsCut(const Neighbours& neighbours, int i, const PairAgreement& given, double typical) {
  const double limit = std::max(kMinCutResidual, kCut * typical);
  const double agreed = kAgreed * limit;
  if (!IsContradicted(given, limit)) return false;
  const PairAgreement before = neighbours.Between(i - 1, i);
  const PairAgreement after = neighbours.Between(i + 1, i + 2);
  const PairAgreement across_before = neighbours.Between(i - 1, i + 1);
  const PairAgreement across_after = neighbours.Between(i, i + 2);
  const bool lasts = IsContradicted(across_before, limit) && IsContradicted(across_after, limit) &&
                     IsAgreed(before, agreed) && IsAgreed(after, agreed);
  const bool next_is_off = IsContradicted(across_before, limit) && IsContradicted(after, limit) &&
                           IsAgreed(across_after, agreed) && IsAgreed(before, agreed);
  const bool this_is_off = IsContradicted(across_after, limit) && IsContradicted(before, limit) &&
                           IsAgreed(across_before, agreed) && IsAgreed(after, agreed);
  return lasts || next_is_off || this_is_off;
}

// Whether the motion leaps, depth contradicts it, and a steady motion explains it.
bool IsContradictedLeap(const Neighbours& neighbours, int i, const PairAgreement& given,
                        double typical) {
  const PairAgreement smooth = neighbours.Smooth(i);
  const bool is_unlike = !given.is_usable || given.residual > kUnlikeOthers * typical;
  const bool is_alike =
      smooth.is_usable && smooth.residual < std::max(kSmoothResidual, kLikeOthers * typical);
  const bool is_contradicted =
      !given.is_usable || smooth.difference < kContradiction * given.difference;
  return is_unlike && is_alike && is_contradicted;
}

bool Straddles(int first, int last, const std::vector<PoseJump>& jumps) {
  return std::any_of(jumps.begin(), jumps.end(), [&](const PoseJump& jump) {
    return jump.frame >= first && jump.frame < last;
  });
}

// How every frame agrees with the one so many frames later; not across jumps.
std::vector<PairAgreement> Later(const DepthViews& views, const FramePoses& poses, int gap,
                                 const std::vector<PoseJump>& jumps) {
  const int count = std::max(0, static_cast<int>(poses.size()) - gap);
  std::vector<PairAgreement> agreements(static_cast<size_t>(count));
  ParallelFor(0, count, 8, [&](int64_t index) {
    const int i = static_cast<int>(index);
    const auto& from = poses[static_cast<size_t>(i)];
    const auto& to = poses[static_cast<size_t>(i + gap)];
    if (!from || !to || !views.Has(i) || !views.Has(i + gap) || Straddles(i, i + gap, jumps))
      return;
    agreements[static_cast<size_t>(i)] = views.Compare({i, i + gap}, to->inverse() * *from);
  });
  return agreements;
}

// How a frame agrees with one before or after it.
struct Comparison {
  size_t other = 0;
  PairAgreement agreement;
};
using Comparisons = std::vector<std::vector<Comparison>>;  // by frame

Comparisons CompareAround(const DepthViews& views, const FramePoses& poses,
                          const std::vector<PoseJump>& jumps) {
  Comparisons comparisons(poses.size());
  for (const int gap : kStretchGaps) {
    const std::vector<PairAgreement> later = Later(views, poses, gap, jumps);
    for (size_t i = 0; i < later.size(); ++i) {
      if (!later[i].is_usable) continue;
      comparisons[i].push_back({i + static_cast<size_t>(gap), later[i]});
      comparisons[i + static_cast<size_t>(gap)].push_back({i, later[i]});
    }
  }
  return comparisons;
}

// Frames that disagree with most of the good ones around them. All count as good at first; frames
// whose neighbours are all bad stay what they are.
std::vector<char> BadFrames(const Comparisons& comparisons, double limit) {
  constexpr int kRounds = 5;
  std::vector<char> is_bad(comparisons.size(), 0);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<char> next = is_bad;
    for (size_t i = 0; i < comparisons.size(); ++i) {
      int balance = 0;
      bool has_good = false;
      for (const auto& [other, agreement] : comparisons[i]) {
        if (is_bad[other] != 0) continue;
        has_good = true;
        balance += agreement.residual > limit ? 1 : -1;
      }
      if (has_good) next[i] = balance > 0 ? 1 : 0;
    }
    if (next == is_bad) break;
    is_bad = std::move(next);
  }
  return is_bad;
}

BadStretch Summarize(const Comparisons& comparisons, double limit, int first, int last) {
  std::vector<double> residuals;
  std::vector<double> differences;
  for (int i = first; i <= last; ++i) {
    for (const Comparison& comparison : comparisons[static_cast<size_t>(i)]) {
      if (comparison.agreement.residual <= limit) continue;
      residuals.push_back(comparison.agreement.residual);
      differences.push_back(comparison.agreement.difference);
    }
  }
  return {first, last, Median(std::move(residuals)), Median(std::move(differences))};
}

}  // namespace

std::vector<PoseJump> FindPoseJumps(const DepthViews& views, const FramePoses& poses) {
  const Neighbours neighbours(views, poses);
  const double distance = TypicalDistance(views, static_cast<int>(poses.size()));
  const PairAgreement typical = TypicalAgreement(neighbours);
  const std::vector<int> leaps = Leaps(neighbours, distance);
  std::vector<char> is_jump(static_cast<size_t>(neighbours.count()), 0);
  std::vector<PairAgreement> given(is_jump.size());
  ParallelFor(0, neighbours.count(), 8, [&](int64_t index) {
    const int i = static_cast<int>(index);
    const auto k = static_cast<size_t>(i);
    if (!neighbours.motion(i)) return;
    given[k] = neighbours.Given(i);
    const bool is_leap = std::binary_search(leaps.begin(), leaps.end(), i);
    is_jump[k] = (is_leap && IsContradictedLeap(neighbours, i, given[k], typical.residual)) ||
                 IsCut(neighbours, i, given[k], typical.residual);
  });
  std::vector<PoseJump> jumps;
  for (int i = 0; i < neighbours.count(); ++i) {
    const auto k = static_cast<size_t>(i);
    if (is_jump[k] == 0) continue;
    const RigidTransform& motion = *neighbours.motion(i);
    jumps.push_back({i, motion.translation().norm(), RotationVector(motion).norm(),
                     given[k].difference, typical.difference});
  }
  return jumps;
}

std::vector<BadStretch> FindBadStretches(const DepthViews& views, const FramePoses& poses,
                                         const std::vector<PoseJump>& jumps) {
  const Comparisons comparisons = CompareAround(views, poses, jumps);
  std::vector<double> residuals;
  for (const auto& of_frame : comparisons) {
    for (const Comparison& comparison : of_frame) {
      residuals.push_back(comparison.agreement.residual);
    }
  }
  if (residuals.empty()) return {};
  const double limit =
      std::max(kMinBadResidual, kWorseThanTypical * Quantile(std::move(residuals), kTypical));
  const std::vector<char> is_bad = BadFrames(comparisons, limit);
  std::vector<BadStretch> stretches;
  const int count = static_cast<int>(is_bad.size());
  for (int first = 0; first < count; ++first) {
    int end = first;
    while (end < count && is_bad[static_cast<size_t>(end)] != 0) ++end;
    if (end - first >= kMinStretch) {
      stretches.push_back(Summarize(comparisons, limit, first, end - 1));
    }
    first = std::max(first, end - 1);
  }
  return stretches;
}

}  // namespace curvefusion
