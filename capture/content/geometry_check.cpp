#include "capture/content/geometry_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "capture/content/clock_search.h"
#include "capture/content/geometry_details.h"
#include "capture/content/geometry_messages.h"
#include "capture/content/pose_explanation.h"
#include "capture/depth_noise.h"
#include "capture/frame_stream.h"
#include "capture/readers/readers.h"
#include "kernel/error.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr int kStarts = 16;  // pairs of each gap; 64 pairs of some 100 frames
constexpr int kSampledStarts = 6;
constexpr std::array<double, 7> kDistances = {0, 0.5, 1, 1.5, 2, 3, 100};
constexpr int kMinPoints = 200;  // of a distance or gap
// Chosen: where poses that stand still cost no more than this factor of the given ones, any poses
// would do.
constexpr double kTellsFactor = 1.3;
constexpr double kTellsMargin = 0.02;  // of cost: a thousandth of the distance
// Chosen: poses adjusted to colour images alone were off by 3 % at most; a vertex lies between
// three factors a percent apart.
constexpr double kScaleStep = 0.01;
constexpr int kScaleSteps = 6;  // to both sides

// Two measurements differ by sqrt(2) sigma, of which the median absolute value is .6745.
double NoiseAt(double distance) {
  return 0.6745 * std::sqrt(2.0) * kNoisePerSquaredDepth * distance * distance;
}

struct Differences {
  std::vector<double> signed_values;
  std::vector<double> absolute_values;
  std::vector<double> distances;

  void Add(const DepthViews::Overlap& overlap) {
    signed_values.push_back(overlap.difference);
    absolute_values.push_back(std::abs(overlap.difference));
    distances.push_back(overlap.distance);
  }
};

DepthDisagreement Summarize(const Differences& differences) {
  DepthDisagreement summary;
  summary.points = static_cast<int>(differences.distances.size());
  summary.distance = Median(differences.distances);
  summary.residual = Median(differences.absolute_values);
  summary.spread =
      Quantile(differences.signed_values, 0.75) - Quantile(differences.signed_values, 0.25);
  summary.noise = NoiseAt(summary.distance);
  return summary;
}

size_t DistanceBin(double distance) {
  const auto next = std::upper_bound(kDistances.begin() + 1, kDistances.end() - 1, distance);
  return static_cast<size_t>(next - kDistances.begin()) - 1;
}

// Fills the figures from the pairs that overlap.
void Measure(const DepthViews& views, const std::vector<FramePair>& pairs, const FramePoses& poses,
             GeometryReport& report) {
  std::map<int, Differences> by_gap;
  std::map<int, std::vector<double>> overlaps;
  std::array<Differences, kDistances.size() - 1> by_distance;
  for (const FramePair& pair : pairs) {
    const auto& from = poses[static_cast<size_t>(pair.from)];
    const auto& to = poses[static_cast<size_t>(pair.to)];
    if (!from || !to) continue;
    int samples = 0;
    const auto found = views.Overlaps(pair.from, pair.to, to->inverse() * *from, samples);
    if (samples == 0) continue;
    overlaps[pair.gap()].push_back(static_cast<double>(found.size()) / samples);
    for (const DepthViews::Overlap& overlap : found) {
      by_gap[pair.gap()].Add(overlap);
      by_distance[DistanceBin(overlap.distance)].Add(overlap);
    }
  }
  for (const auto& [gap, differences] : by_gap) {
    if (differences.distances.size() < kMinPoints) continue;
    report.by_gap.push_back(Summarize(differences));
    report.by_gap.back().gap = gap;
    report.by_gap.back().overlap = Median(overlaps[gap]);
  }
  for (const Differences& differences : by_distance) {
    if (differences.distances.size() >= kMinPoints) {
      report.by_distance.push_back(Summarize(differences));
    }
  }
}

std::vector<double> TimesOf(const Sequence& sequence) {
  std::vector<double> times;
  for (const SequenceFrame& frame : sequence.frames) times.push_back(frame.timestamp);
  return times;
}

double MedianStep(const std::vector<double>& times) {
  std::vector<double> steps;
  for (size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  return steps.empty() ? 1 : Median(std::move(steps));
}

Trajectory RawTrajectory(const Sequence& sequence) {
  if (sequence.format != "tum") return {};
  return ReadTumTrajectory(TumTrajectoryPath(sequence.folder), [](const CheckFinding&) {});
}

MisfitEvidence EvidenceOf(const Sequence& sequence, const Thumbnails& thumbnails,
                          std::vector<FramePair> pairs) {
  MisfitEvidence evidence{thumbnails, sequence.depth_scale, std::move(pairs), GivenPoses(sequence)};
  evidence.trajectory = RawTrajectory(sequence);
  if (evidence.trajectory.empty()) return evidence;
  evidence.times = TimesOf(sequence);
  evidence.frame_period = MedianStep(evidence.times);
  return evidence;
}

SequenceCorrection CorrectionOf(const Sequence& sequence, const Misfit& misfit) {
  SequenceCorrection correction{sequence, misfit.explanation.swap_bytes, {misfit.remedy}};
  correction.sequence.depth_scale = misfit.depth_scale;
  correction.sequence.frames.clear();
  for (size_t i = 0; i < sequence.frames.size(); ++i) {
    if (!misfit.poses[i]) continue;
    correction.sequence.frames.push_back(sequence.frames[i]);
    correction.sequence.frames.back().T_world_camera = *misfit.poses[i];
  }
  return correction;
}

GeometryReport Judge(const Sequence& sequence, const Thumbnails& thumbnails,
                     const std::vector<FramePair>& pairs, const FindingHandler& on_finding) {
  GeometryReport report;
  report.frames = static_cast<int>(FramesOf(pairs).size());
  const MisfitEvidence evidence = EvidenceOf(sequence, thumbnails, pairs);
  const DepthViews views(thumbnails, sequence.depth_scale);
  Measure(views, pairs, evidence.poses, report);
  PoseSearch search{MeasureAgreement(views, pairs, evidence.poses), std::nullopt};
  if (!FitsAsGiven(evidence, search.given)) search = ExplainMisfit(evidence);
  if (search.best) {
    report.is_judged = true;
    const Misfit misfit = DescribeMisfit(sequence, evidence, search);
    on_finding(misfit.finding);
    report.mistakes.push_back({misfit.finding.cause, {}, misfit.amount});
    report.correction = CorrectionOf(sequence, misfit);
    return report;
  }
  if (search.given.usable < kMinJudgedPairs) {
    report.why_not = "too few views overlap";
    return report;
  }
  const PoseAgreement standing =
      MeasureAgreement(views, pairs, StandingPoses(evidence.poses.size()));
  const double residual = WideResidual(pairs, search.given);
  if (residual > kMaxWideResidual && FitsElsewhere(views, pairs, evidence.poses)) {
    report.is_judged = true;
    report.fits = true;
  } else if (residual > kMaxWideResidual) {
    report.is_judged = true;
    on_finding(UnexplainedMisfit(sequence, search.given, residual, standing));
  } else if (standing.usable >= search.given.usable &&
             standing.cost < kTellsFactor * search.given.cost + kTellsMargin) {
    report.why_not = "the depth images hardly differ: the camera stands still or sees one plane";
  } else {
    report.is_judged = true;
    report.fits = true;
  }
  return report;
}

// Depth of some frames of a sequence, pairs of which are compared by whatever poses.
class SampledDepth {
 public:
  SampledDepth(const Sequence& sequence, const std::vector<int>& frames)
      : views_(DepthThumbnails(sequence, frames), sequence.depth_scale) {}

  // Shares of depth, in the median; nothing where it cannot tell.
  std::optional<double> Misfit(const std::vector<FramePair>& pairs, const Sequence& poses) const {
    const std::optional<PoseAgreement> agreement = Agreement(pairs, poses);
    if (!agreement) return std::nullopt;
    return WideResidual(pairs, *agreement);
  }

  // The same of all pairs alike.
  std::optional<double> MisfitOfAll(const std::vector<FramePair>& pairs,
                                    const Sequence& poses) const {
    const std::optional<PoseAgreement> agreement = Agreement(pairs, poses);
    if (!agreement) return std::nullopt;
    return agreement->residual;
  }

  // The same in the mean: some pairs on which poses disagree move no median.
  std::optional<double> MeanMisfit(const std::vector<FramePair>& pairs,
                                   const Sequence& poses) const {
    const std::optional<PoseAgreement> agreement = Agreement(pairs, poses);
    if (!agreement) return std::nullopt;
    double sum = 0;
    for (const PairAgreement& pair : agreement->pairs) sum += pair.is_usable ? pair.residual : 0;
    return sum / agreement->usable;
  }

 private:
  std::optional<PoseAgreement> Agreement(const std::vector<FramePair>& pairs,
                                         const Sequence& poses) const {
    if (views_.empty()) return std::nullopt;
    PoseAgreement agreement = MeasureAgreement(views_, pairs, GivenPoses(poses));
    if (agreement.usable < kMinJudgedPairs) return std::nullopt;
    return agreement;
  }

  DepthViews views_;
};

// Frames 10 and 30 apart, where a sequence is that long: errors of poses have grown between them.
std::vector<FramePair> WidePairs(const Sequence& sequence) {
  std::vector<FramePair> pairs = SpreadPairs(sequence.frame_count(), kSampledStarts);
  const auto narrow = std::stable_partition(
      pairs.begin(), pairs.end(), [](const FramePair& pair) { return pair.gap() >= kWideGap; });
  if (narrow != pairs.begin()) pairs.erase(narrow, pairs.end());
  return pairs;
}

// All pairs of some frames: those that are far apart tell most of scale, and of single jumps.
std::vector<FramePair> AllPairs(const std::vector<int>& frames) {
  std::vector<FramePair> pairs;
  for (size_t i = 0; i < frames.size(); ++i)
    for (size_t j = i + 1; j < frames.size(); ++j) pairs.push_back({frames[i], frames[j]});
  return pairs;
}

Sequence WithPositionsTimes(double factor, const Sequence& sequence) {
  Sequence scaled = sequence;
  for (SequenceFrame& frame : scaled.frames) frame.T_world_camera.translation() *= factor;
  return scaled;
}

}  // namespace

GeometryReport CheckGeometry(const Sequence& sequence, const Thumbnails& thumbnails,
                             const FindingHandler& on_finding) {
  if (thumbnails.depth.empty()) return {};
  GeometryReport report =
      Judge(sequence, thumbnails, SpreadPairs(sequence.frame_count(), kStarts), on_finding);
  if (report.fits) ExamineDetails(sequence, thumbnails, on_finding, report);
  return report;
}

GeometryReport CheckClocks(const Sequence& sequence, const FindingHandler& on_finding) {
  GeometryReport report;
  const std::vector<FramePair> pairs = SpreadPairs(sequence.frame_count(), kSampledStarts);
  const Thumbnails thumbnails = DepthThumbnails(sequence, FramesOf(pairs));
  MisfitEvidence evidence = EvidenceOf(sequence, thumbnails, pairs);
  evidence.poses.assign(evidence.poses.size(), std::nullopt);
  const std::optional<PoseSearch> search = FindDistantClock(evidence);
  if (!search) return report;
  report.is_judged = true;
  const Misfit misfit = DescribeMisfit(sequence, evidence, *search);
  on_finding(misfit.finding);
  report.mistakes.push_back({misfit.finding.cause, {}, misfit.amount});
  report.correction = CorrectionOf(sequence, misfit);
  return report;
}

void RequireFittingPoses(Sequence& sequence) {
  const std::vector<FramePair> pairs = SpreadPairs(sequence.frame_count(), kSampledStarts);
  const Thumbnails thumbnails = DepthThumbnails(sequence, FramesOf(pairs));
  if (thumbnails.depth.empty()) return;
  Judge(sequence, thumbnails, pairs, [&sequence](const CheckFinding& finding) {
    if (finding.severity == Severity::kError) throw Error(ErrorKind::kBadInput, finding.message);
    sequence.warnings.push_back(finding.message);
  });
}

bool DepthDisagrees(const Sequence& sequence) {
  const std::vector<FramePair> pairs = SpreadPairs(sequence.frame_count(), kSampledStarts);
  return SampledDepth(sequence, FramesOf(pairs)).Misfit(pairs, sequence).value_or(0) >
         kMaxWideResidual;
}

std::optional<double> ScaleByDepth(const Sequence& sequence) {
  const std::vector<int> frames = EvenlyThinned(AllFrames(sequence), kStarts);
  const SampledDepth depth(sequence, frames);
  const std::vector<FramePair> pairs = AllPairs(frames);
  std::vector<double> misfits;
  for (int step = -kScaleSteps; step <= kScaleSteps; ++step) {
    const auto misfit =
        depth.MisfitOfAll(pairs, WithPositionsTimes(1 + kScaleStep * step, sequence));
    if (!misfit) return std::nullopt;
    misfits.push_back(*misfit);
  }
  const auto least = std::min_element(misfits.begin(), misfits.end());
  if (least == misfits.begin() || least + 1 == misfits.end()) return std::nullopt;
  const double vertex = 0.5 * (least[-1] - least[1]) / (least[-1] - 2 * least[0] + least[1]);
  const double steps = static_cast<double>(least - misfits.begin()) - kScaleSteps + vertex;
  return 1 + kScaleStep * steps;
}

std::vector<int> FramesOfGain(const Sequence& sequence) { return FramesOf(WidePairs(sequence)); }

std::optional<DepthGain> GainOfDepth(const Sequence& given, const Sequence& corrected) {
  const auto ratio = [](const std::optional<double>& before, const std::optional<double>& after) {
    return before && after && *after > 0 ? std::optional(*before / *after) : std::nullopt;
  };
  const std::vector<FramePair> wide = WidePairs(given);
  const std::vector<int> frames = FramesOf(wide);
  const SampledDepth depth(given, frames);
  const std::optional<double> near =
      ratio(depth.Misfit(wide, given), depth.Misfit(wide, corrected));
  if (!near) return std::nullopt;
  const std::vector<FramePair> all = AllPairs(frames);
  const std::optional<double> far =
      ratio(depth.MeanMisfit(all, given), depth.MeanMisfit(all, corrected));
  return DepthGain{*near, far.value_or(1)};
}

}  // namespace curvefusion
