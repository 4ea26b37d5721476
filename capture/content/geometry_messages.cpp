#include "capture/content/geometry_messages.h"

#include <fmt/format.h>

#include <cmath>

#include "capture/content/scale_choice.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Chosen: with poses that err by more the result is of no use. A few frames' delay errs by less.
constexpr double kHarmlessResidual = 0.02;

// Where the poses of a layout stand.
std::string PoseFiles(const Sequence& sequence) {
  if (sequence.format == "redwood") return "trajectory.log";
  if (sequence.format == "7-scenes") return "frame-*.pose.txt";
  if (sequence.format == "tum") return "the trajectory";
  if (sequence.format == "sens") return "the recording";
  return "pose/*.txt";
}

double MedianDepth(const MisfitEvidence& evidence) {
  std::vector<double> values;
  for (const int frame : FramesOf(evidence.pairs)) {
    const Image<uint16_t>& depth = evidence.thumbnails.depth[static_cast<size_t>(frame)];
    for (size_t i = 0; i < depth.size(); i += 7) {
      if (depth.data()[i] > 0) values.push_back(depth.data()[i] / evidence.depth_scale);
    }
  }
  return values.empty() ? 0 : Median(std::move(values));
}

// Metres a second; 0 where there are no times.
double MedianSpeed(const MisfitEvidence& evidence) {
  std::vector<double> speeds;
  for (size_t i = 1; i < evidence.times.size(); ++i) {
    const double time = evidence.times[i] - evidence.times[i - 1];
    const auto& before = evidence.poses[i - 1];
    const auto& after = evidence.poses[i];
    if (time > 0) speeds.push_back((after->translation() - before->translation()).norm() / time);
  }
  return speeds.empty() ? 0 : Median(std::move(speeds));
}

// "depth of different views disagrees by 61 mm as given and by 3 mm so"
std::string Evidence(const PoseAgreement& given, const PoseAgreement& then, double unit_change) {
  const std::string now =
      given.usable >= kMinJudgedPairs
          ? fmt::format("disagrees by {:.3g} mm as given", 1e3 * given.difference)
          : "does not overlap at all as given";
  return fmt::format(
      "depth of different views {}, by {:.2g} mm so ({} pairs of views, overlap {:.0f} %)", now,
      1e3 * then.difference * unit_change, then.usable, 100 * then.overlap);
}

struct Words {
  std::string what;    // is wrong
  std::string remedy;  // to be done by hand
};

// What is to be written instead, or by how much the poses come late.
std::optional<MistakeAmount> AmountOf(const PoseExplanation& explanation,
                                      const std::optional<ScaleChoice>& choice) {
  if (choice) return MistakeAmount{choice->value, choice->is_depth ? "units per metre" : "factor"};
  if (explanation.cause == "poses-late") return MistakeAmount{explanation.value, "frames"};
  if (explanation.cause == "clock-offset") return MistakeAmount{explanation.value, "s"};
  return std::nullopt;
}

std::string RepairHint(const Sequence& sequence) {
  return fmt::format("or write a corrected copy with: curvefusion check {} --repair DIR",
                     sequence.folder.string());
}

Words WordsOfScale(const Sequence& sequence, const ScaleChoice& choice, double given_scale) {
  const std::string depth_line = fmt::format("\"depth_scale\": {:g}", choice.value);
  if (choice.is_depth) {
    const std::string other =
        choice.other_is_possible
            ? fmt::format(" (translations times {:.3g} would explain the images as well)",
                          choice.other)
            : "";
    return {fmt::format("the depth unit is wrong: depth_scale is {:g}, it should be {:g}{}",
                        given_scale, choice.value, other),
            fmt::format("write {} in {}", depth_line, IntrinsicsFile(sequence))};
  }
  const std::string unit = UnitOfFactor(choice.value);
  const std::string what =
      unit.empty() ? fmt::format(
                         "the translations of the poses have another scale than depth: "
                         "they must be multiplied by {:.4g}",
                         choice.value)
                   : fmt::format("the translations of the poses are in {}, not metres", unit);
  const std::string other =
      choice.other_is_possible
          ? fmt::format(" (\"depth_scale\": {:.4g} would explain the images as well)", choice.other)
          : "";
  return {what + other, fmt::format("multiply the translations in {} by {:.4g}",
                                    PoseFiles(sequence), choice.value)};
}

Words WordsOfDelay(const Sequence& sequence, const MisfitEvidence& evidence, double delay) {
  const char* late = delay > 0 ? "late" : "early";
  if (evidence.trajectory.empty()) {
    const int frames = static_cast<int>(std::lround(std::abs(delay)));
    return {fmt::format("the poses are {} by {} frame{}: image i belongs to pose i {} {}", late,
                        frames, frames == 1 ? "" : "s", delay > 0 ? '+' : '-', frames),
            fmt::format("renumber {} by {}", PoseFiles(sequence), -std::lround(delay))};
  }
  return {fmt::format("the clocks differ: the poses' stamps are {:.3f} s ({:.1f} frames) {}",
                      std::abs(delay), std::abs(delay) / evidence.frame_period, late),
          fmt::format("{} {:.3f} {} every stamp of {}", delay > 0 ? "subtract" : "add",
                      std::abs(delay), delay > 0 ? "from" : "to", PoseFiles(sequence))};
}

std::string RemedyOf(const std::string& cause, const Sequence& sequence) {
  const std::string files = PoseFiles(sequence);
  if (cause == "poses-inverted") return fmt::format("write the inverse of each pose to {}", files);
  if (cause == "quaternion-w-first") {
    return fmt::format("write {} as t tx ty tz qx qy qz qw", files);
  }
  if (cause == "opengl-axes") {
    return fmt::format("change the sign of the second and third column of each rotation in {}",
                       files);
  }
  if (cause == "depth-bytes-swapped") return "write the depth images with the other byte order";
  return fmt::format("put {} into the order of the images", files);
}

void Apply(const ScaleChoice& choice, const MisfitEvidence& evidence, Misfit& misfit) {
  misfit.finding.cause = choice.is_depth ? "depth-scale" : "translation-scale";
  if (choice.is_depth) {
    misfit.depth_scale = choice.value;
    misfit.poses = evidence.poses;
  } else {
    misfit.poses = ScaledTranslations(evidence.poses, choice.value);
  }
}

}  // namespace

std::string IntrinsicsFile(const Sequence& sequence) {
  if (sequence.format == "redwood") return "intrinsic.json";
  return sequence.IsRecording() ? "the intrinsics.json of a copy" : "intrinsics.json";
}

Misfit DescribeMisfit(const Sequence& sequence, const MisfitEvidence& evidence,
                      const PoseSearch& search) {
  Misfit misfit;
  misfit.explanation = *search.best;
  misfit.poses = search.best->poses;
  misfit.depth_scale = evidence.depth_scale;
  misfit.finding.cause = search.best->cause;
  Words words{search.best->description, RemedyOf(search.best->cause, sequence)};
  double unit_change = 1;
  std::optional<ScaleChoice> choice;
  if (search.best->cause == "translation-scale") {
    choice = ChooseScale(
        {search.best->value, evidence.depth_scale, MedianDepth(evidence), MedianSpeed(evidence)});
    Apply(*choice, evidence, misfit);
    words = WordsOfScale(sequence, *choice, evidence.depth_scale);
    unit_change = evidence.depth_scale / misfit.depth_scale;
  } else if (search.best->cause == "poses-late" || search.best->cause == "clock-offset") {
    words = WordsOfDelay(sequence, evidence, search.best->value);
    if (search.given.usable >= kMinJudgedPairs &&
        WideResidual(evidence.pairs, search.given) < kHarmlessResidual) {
      misfit.finding.severity = Severity::kWarning;
    }
  }
  misfit.amount = AmountOf(*search.best, choice);
  misfit.remedy = words.remedy;
  misfit.finding.message = fmt::format("{}: {}: {}; {}, {}", sequence.folder.string(), words.what,
                                       Evidence(search.given, search.best->agreement, unit_change),
                                       words.remedy, RepairHint(sequence));
  return misfit;
}

CheckFinding UnexplainedMisfit(const Sequence& sequence, const PoseAgreement& given,
                               double residual, const PoseAgreement& standing) {
  const std::string still =
      standing.usable >= kMinJudgedPairs && standing.residual < kHarmlessResidual / 2
          ? "; the depth images are those of a camera that stands still"
          : "";
  return {Severity::kError,
          fmt::format("{}: the poses and the depth do not fit, and no known cause explains it: "
                      "depth of different views disagrees by {:.3g} mm in the median, over ten "
                      "frames and more by {:.1f} % of the distance (limit {:.0f} %){}; look at the "
                      "tracking, the depth camera's intrinsics and at which pose belongs to which "
                      "image",
                      sequence.folder.string(), 1e3 * given.difference, 100 * residual,
                      100 * kMaxWideResidual, still),
          "poses-do-not-fit"};
}

}  // namespace curvefusion
