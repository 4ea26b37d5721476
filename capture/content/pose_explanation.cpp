#include "capture/content/pose_explanation.h"

#include <algorithm>
#include <cmath>

#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Measured over good scans (`curvefusion experiment check`): a hypothesis that is not true
// costs more than the poses as given, or at best as much; the true one of a wrong version costs
// less than half. One clock of TUM's fr1_rpy is off by 20 ms and gives .7.
constexpr double kMuchBetter = 0.6;
constexpr double kMuchBetterFine = 0.45;  // for clocks off by less than a frame
// Measured likewise: wide residuals of good scans are .002 to .006 (fr1_rpy .013, which is searched
// in vain); those of wrong versions that fit best, .005 (poses one frame late), are found by the
// neighbours looked at.
constexpr double kPlainFit = 0.007;
constexpr double kWorseIfStanding = 2;     // cost of no motion; good scans: 3 to 8
constexpr double kMinImprovement = 0.015;  // of cost: a thousandth of the distance
constexpr double kBetter = 0.85;           // chosen: a reason to look closer
constexpr double kRunnerUpMargin = 1.25;
constexpr double kPairsThatAgree = 0.75;  // share; half would by chance
constexpr double kMinUsableShare = 0.3;
constexpr int kMinUsablePairs = 4;
constexpr double kMaxResidual = 0.025;  // of what explains; good scans have .002 to .01
constexpr int kMaxDelay = 10;           // frames
constexpr double kScaleStep = 1.2;      // inside the basin of the right scale: 0.8 to 1.25
constexpr double kMaxScale = 3000;
constexpr double kNoScale = 1.07;      // what calibration may be off by
constexpr double kScaleMargin = 1.15;  // chosen: of the cost at three times and a third of a scale

bool IsEnough(const PoseAgreement& agreement) {
  return agreement.usable >= kMinUsablePairs &&
         agreement.usable >= kMinUsableShare * static_cast<double>(agreement.pairs.size());
}

// Share of the pairs usable with `better` on which it costs less than with `worse`.
double ShareThatAgrees(const PoseAgreement& better, const PoseAgreement& worse) {
  int agree = 0;
  for (size_t i = 0; i < better.pairs.size(); ++i) {
    if (!better.pairs[i].is_usable) continue;
    if (!worse.pairs[i].is_usable || better.pairs[i].cost < worse.pairs[i].cost) ++agree;
  }
  return better.usable == 0 ? 0 : static_cast<double>(agree) / better.usable;
}

// Keeps the better of two explanations of one family.
void Consider(PoseExplanation candidate, std::optional<PoseExplanation>& best) {
  if (!IsEnough(candidate.agreement)) return;
  if (!best || candidate.agreement.cost < best->agreement.cost) best = std::move(candidate);
}

class Search {
 public:
  explicit Search(const MisfitEvidence& evidence)
      : evidence_(evidence), views_(evidence.thumbnails, evidence.depth_scale) {}

  PoseAgreement Agreement(const FramePoses& poses) const {
    return MeasureAgreement(views_, evidence_.pairs, poses);
  }

  // One entry a cause, where any of its members can be judged.
  std::vector<PoseExplanation> Families() const {
    std::vector<PoseExplanation> families;
    const auto add = [&families](std::optional<PoseExplanation> best) {
      if (best) families.push_back(std::move(*best));
    };
    for (const PoseHypothesis& hypothesis : ConventionHypotheses(evidence_.poses)) {
      add(BestOf({hypothesis}));
    }
    add(BestOf(OrderHypotheses(evidence_.poses)));
    add(BestScale());
    add(BestDelay());
    add(SwappedBytes());
    return families;
  }

  FramePoses Delayed(double delay) const {
    return evidence_.trajectory.empty()
               ? DelayedPoses(evidence_.poses, static_cast<int>(std::lround(delay)))
               : PosesAt(evidence_.trajectory, evidence_.times, delay);
  }

  double DelayStep() const {
    return evidence_.trajectory.empty() ? 1 : 0.5 * evidence_.frame_period;
  }

 private:
  std::optional<PoseExplanation> BestOf(const std::vector<PoseHypothesis>& hypotheses) const {
    std::optional<PoseExplanation> best;
    for (const PoseHypothesis& hypothesis : hypotheses) {
      Consider({hypothesis.cause, hypothesis.description, hypothesis.poses, false, 0,
                Agreement(hypothesis.poses)},
               best);
    }
    return best;
  }

  PoseExplanation AtScale(double factor) const {
    FramePoses poses = ScaledTranslations(evidence_.poses, factor);
    PoseAgreement agreement = Agreement(poses);
    return {"translation-scale", "", std::move(poses), false, factor, std::move(agreement)};
  }

  // Nearly no translation costs the same at any scale: then a scale says nothing.
  bool IsDetermined(const PoseExplanation& scale) const {
    if (std::max(scale.value, 1 / scale.value) < kNoScale) return false;
    const double limit = kScaleMargin * scale.agreement.cost;
    return AtScale(3 * scale.value).agreement.cost > limit &&
           AtScale(scale.value / 3).agreement.cost > limit;
  }

  std::optional<PoseExplanation> BestScale() const {
    std::optional<PoseExplanation> best;
    for (double factor = kNoScale; factor < kMaxScale; factor *= kScaleStep) {
      Consider(AtScale(factor), best);
      Consider(AtScale(1 / factor), best);
    }
    for (double step = std::sqrt(kScaleStep); best && step > 1.002; step = std::sqrt(step)) {
      const double factor = best->value;
      Consider(AtScale(factor * step), best);
      Consider(AtScale(factor / step), best);
    }
    if (best && !IsDetermined(*best)) best.reset();
    return best;
  }

  PoseExplanation AtDelay(double delay) const {
    FramePoses poses = Delayed(delay);
    PoseAgreement agreement = Agreement(poses);
    return {evidence_.trajectory.empty() ? "poses-late" : "clock-offset",
            "",
            std::move(poses),
            false,
            delay,
            std::move(agreement),
            std::abs(delay) < evidence_.frame_period};
  }

  std::optional<PoseExplanation> BestDelay() const {
    std::optional<PoseExplanation> best;
    const double greatest = kMaxDelay * (evidence_.trajectory.empty() ? 1 : evidence_.frame_period);
    for (double delay = DelayStep(); delay < 1.001 * greatest; delay += DelayStep()) {
      Consider(AtDelay(delay), best);
      Consider(AtDelay(-delay), best);
    }
    if (evidence_.trajectory.empty()) return best;
    for (double step = DelayStep() / 2; best && step > 0.001; step /= 2) {
      const double delay = best->value;
      Consider(AtDelay(delay + step), best);
      Consider(AtDelay(delay - step), best);
    }
    return best;
  }

  std::optional<PoseExplanation> SwappedBytes() const {
    const DepthViews swapped(evidence_.thumbnails, evidence_.depth_scale, true);
    std::optional<PoseExplanation> best;
    Consider(
        {"depth-bytes-swapped", "the bytes of the 16-bit depth values are swapped", evidence_.poses,
         true, 0, MeasureAgreement(swapped, evidence_.pairs, evidence_.poses)},
        best);
    return best;
  }

  const MisfitEvidence& evidence_;
  DepthViews views_;
};

bool Explains(const PoseExplanation& candidate, const PoseAgreement& given) {
  const PoseAgreement& agreement = candidate.agreement;
  const bool given_is_judged = IsEnough(given);
  const double much_better = candidate.is_fine ? kMuchBetterFine : kMuchBetter;
  return agreement.residual <= kMaxResidual &&
         (!given_is_judged || (agreement.cost <= much_better * given.cost &&
                               agreement.cost <= given.cost - kMinImprovement)) &&
         ShareThatAgrees(agreement, given) >= kPairsThatAgree;
}

}  // namespace

double WideResidual(const std::vector<FramePair>& pairs, const PoseAgreement& agreement) {
  std::vector<double> wide;
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (agreement.pairs[i].is_usable && pairs[i].gap() >= kWideGap) {
      wide.push_back(agreement.pairs[i].residual);
    }
  }
  return wide.size() < kMinUsablePairs ? agreement.residual : Median(std::move(wide));
}

bool FitsAsGiven(const MisfitEvidence& evidence, const PoseAgreement& given) {
  if (!IsEnough(given) || WideResidual(evidence.pairs, given) > kPlainFit) return false;
  const Search search(evidence);
  const auto is_better = [&](const FramePoses& poses) {
    const PoseAgreement other = search.Agreement(poses);
    return IsEnough(other) && other.cost < kBetter * given.cost;
  };
  const PoseAgreement standing = search.Agreement(StandingPoses(evidence.poses.size()));
  if (standing.cost < kWorseIfStanding * given.cost) return false;
  for (const double steps : {-3.0, -2.0, -1.0, 1.0, 2.0, 3.0}) {
    if (is_better(search.Delayed(steps * search.DelayStep()))) return false;
  }
  for (const double factor : {0.5, 1 / kScaleStep, kScaleStep, 2.0}) {
    if (is_better(ScaledTranslations(evidence.poses, factor))) return false;
  }
  return true;
}

PoseSearch ExplainMisfit(const MisfitEvidence& evidence) {
  const Search search(evidence);
  PoseSearch result{search.Agreement(evidence.poses), std::nullopt};
  std::vector<PoseExplanation> families = search.Families();
  std::sort(families.begin(), families.end(),
            [](const PoseExplanation& a, const PoseExplanation& b) {
              return a.agreement.cost < b.agreement.cost;
            });
  if (families.empty() || !Explains(families[0], result.given)) return result;
  const bool is_alone = families.size() == 1 ||
                        families[1].agreement.cost >= kRunnerUpMargin * families[0].agreement.cost;
  if (is_alone) result.best = std::move(families[0]);
  return result;
}

}  // namespace curvefusion
