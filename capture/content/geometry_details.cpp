#include "capture/content/geometry_details.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>

#include "capture/content/color_delay.h"
#include "capture/content/geometry_messages.h"
#include "capture/content/pose_jumps.h"

namespace curvefusion {

namespace {

constexpr int kMaxOutliers = 10;  // frames between a leap and the leap back
// Measured on 5 real and 4 simulated recordings: colour one frame late costs 1.4 to 2.3 times as
// much as in time, and 3 of 4 pairs of frames say so; in time no other delay costs less.
constexpr double kColorCostRatio = 0.8;
constexpr double kMaxColorCost = 0.7;  // in time .17 to .51
constexpr double kColorShare = 0.7;
constexpr int kHarmlessColorDelay = 1;  // a few pixels
constexpr size_t kMaxListed = 5;

SequenceCorrection& Correction(const Sequence& sequence, GeometryReport& report) {
  if (!report.correction) {
    report.correction = SequenceCorrection{sequence, false, {}};
  }
  return *report.correction;
}

std::string NameOf(const Sequence& sequence, int frame) {
  return sequence.frames[static_cast<size_t>(frame)].name;
}

std::string RepairHint(const Sequence& sequence) {
  return fmt::format("write a corrected copy with: curvefusion check {} --repair DIR",
                     sequence.folder.string());
}

std::string JumpText(const Sequence& sequence, const PoseJump& jump) {
  return fmt::format(
      "from frame {} to {} by {:.1f} mm and {:.2f} degrees (depth differs by {:.2g} "
      "mm, between other neighbours by {:.2g} mm)",
      NameOf(sequence, jump.frame), NameOf(sequence, jump.frame + 1), 1e3 * jump.translation,
      jump.rotation * 180 / M_PI, 1e3 * jump.difference, 1e3 * jump.usual_difference);
}

std::string Listed(const std::vector<std::string>& texts) {
  std::string list;
  for (size_t i = 0; i < std::min(texts.size(), kMaxListed); ++i) {
    list += (i > 0 ? "; " : "") + texts[i];
  }
  if (texts.size() > kMaxListed) list += fmt::format("; and {} more", texts.size() - kMaxListed);
  return list;
}

// A leap and the leap back: the frames between them have wrong poses.
struct Outliers {
  int first = 0;
  int last = 0;
};

// The frames between a leap and the next, or the one before or behind it, where depth agrees again
// once they are left out.
std::optional<Outliers> OutliersAt(const DepthViews& views, const FramePoses& poses,
                                   const PoseJump& jump, int next_jump) {
  const int count = static_cast<int>(poses.size());
  const auto agrees_without = [&](const Outliers& outliers) {
    const int before = outliers.first - 1;
    const int after = outliers.last + 1;
    if (before < 0 || after >= count || after - before > kMaxOutliers + 1) return false;
    const auto& from = poses[static_cast<size_t>(before)];
    const auto& to = poses[static_cast<size_t>(after)];
    if (!from || !to || !views.Has(before) || !views.Has(after)) return false;
    const PairAgreement across = views.Compare({before, after}, to->inverse() * *from);
    return across.is_usable && across.difference < 0.5 * jump.difference;
  };
  for (const Outliers outliers :
       {Outliers{jump.frame + 1, next_jump}, Outliers{jump.frame + 1, jump.frame + 1},
        Outliers{jump.frame, jump.frame}}) {
    if (outliers.first <= outliers.last && agrees_without(outliers)) return outliers;
  }
  return std::nullopt;
}

// Takes out of `jumps` those around such frames.
std::vector<Outliers> TakeOutliers(const DepthViews& views, const FramePoses& poses,
                                   std::vector<PoseJump>& jumps) {
  std::vector<Outliers> all;
  std::vector<PoseJump> others;
  for (size_t i = 0; i < jumps.size(); ++i) {
    if (!all.empty() && jumps[i].frame <= all.back().last) continue;
    const int next_jump = i + 1 < jumps.size() ? jumps[i + 1].frame : 0;
    if (const auto outliers = OutliersAt(views, poses, jumps[i], next_jump)) {
      all.push_back(*outliers);
    } else {
      others.push_back(jumps[i]);
    }
  }
  jumps = std::move(others);
  return all;
}

void ReportOutliers(const Sequence& sequence, const std::vector<Outliers>& outliers,
                    const std::vector<PoseJump>& all_jumps, const FindingHandler& on_finding,
                    GeometryReport& report) {
  if (outliers.empty()) return;
  std::vector<std::string> names;
  std::vector<FrameStretch> frames;
  std::set<std::string> left_out;
  for (const Outliers& stretch : outliers) {
    frames.push_back({NameOf(sequence, stretch.first), NameOf(sequence, stretch.last)});
    names.push_back(stretch.first == stretch.last ? NameOf(sequence, stretch.first)
                                                  : NameOf(sequence, stretch.first) + " to " +
                                                        NameOf(sequence, stretch.last));
    for (int i = stretch.first; i <= stretch.last; ++i) left_out.insert(NameOf(sequence, i));
  }
  on_finding({Severity::kWarning,
              fmt::format("{}: the poses of these frames are off: {}; the first leap: {}; remove "
                          "the frames, or {}",
                          sequence.folder.string(), Listed(names),
                          JumpText(sequence, all_jumps.front()), RepairHint(sequence)),
              "pose-jump"});
  report.mistakes.push_back({"pose-jump", frames});
  SequenceCorrection& correction = Correction(sequence, report);
  std::erase_if(correction.sequence.frames,
                [&](const SequenceFrame& frame) { return left_out.contains(frame.name); });
  correction.made.push_back(fmt::format("{} frames with wrong poses left out", left_out.size()));
}

void ReportJumps(const Sequence& sequence, const std::vector<PoseJump>& jumps,
                 const FindingHandler& on_finding, GeometryReport& report) {
  if (jumps.empty()) return;
  std::vector<std::string> texts;
  std::vector<FrameStretch> frames;
  for (const PoseJump& jump : jumps) {
    texts.push_back(JumpText(sequence, jump));
    frames.push_back({NameOf(sequence, jump.frame), NameOf(sequence, jump.frame + 1)});
  }
  on_finding({Severity::kError,
              fmt::format("{}: the trajectory jumps and the images do not: {}; what is seen before "
                          "and after comes out twice: track the scan again, or use only the frames "
                          "before or after",
                          sequence.folder.string(), Listed(texts)),
              "pose-jump"});
  report.mistakes.push_back({"pose-jump", frames});
}

void ReportStretches(const Sequence& sequence, const std::vector<BadStretch>& stretches,
                     const FindingHandler& on_finding, GeometryReport& report) {
  if (stretches.empty()) return;
  std::vector<std::string> texts;
  std::vector<FrameStretch> frames;
  for (const BadStretch& stretch : stretches) {
    frames.push_back({NameOf(sequence, stretch.first), NameOf(sequence, stretch.last)});
    texts.push_back(fmt::format("{} to {} by {:.2g} mm ({:.1f} % of the distance)",
                                NameOf(sequence, stretch.first), NameOf(sequence, stretch.last),
                                1e3 * stretch.difference, 100 * stretch.residual));
  }
  on_finding({Severity::kWarning,
              fmt::format("{}: in these frames poses and depth disagree much more than elsewhere: "
                          "{}; the tracking was lost or something moved: remove the frames",
                          sequence.folder.string(), Listed(texts)),
              "bad-stretch"});
  report.mistakes.push_back({"bad-stretch", frames});
}

// Gives each frame the colour image of the frame `delay` later; frames without one are left out.
void MoveColor(const Sequence& sequence, int delay, SequenceCorrection& correction) {
  std::vector<SequenceFrame> moved;
  const int count = sequence.frame_count();
  for (int i = std::max(0, -delay); i < count && i + delay < count; ++i) {
    moved.push_back(sequence.frames[static_cast<size_t>(i)]);
    const SequenceFrame& other = sequence.frames[static_cast<size_t>(i + delay)];
    moved.back().color_path = other.color_path;
    moved.back().color_part = other.color_part;
  }
  correction.sequence.frames = std::move(moved);
  correction.made.push_back(fmt::format("colour images moved by {} frames", -delay));
}

void ReportColorDelay(const Sequence& sequence, const std::optional<ColorDelay>& delay,
                      const FindingHandler& on_finding, GeometryReport& report) {
  if (!delay || delay->frames == 0 || delay->share < kColorShare || delay->then > kMaxColorCost ||
      delay->then > kColorCostRatio * delay->given) {
    return;
  }
  const int frames = std::abs(delay->frames);
  on_finding({frames > kHarmlessColorDelay ? Severity::kError : Severity::kWarning,
              fmt::format(
                  "{}: the colour images are {} frame{} {} against depth: colour moves from image "
                  "to image as depth and poses say, but {} (brightness of the same points differs "
                  "by {:.0f} % of what a camera that stands still would give, and by {:.0f} % so); "
                  "depth image i belongs to colour image i {} {}: pair them so, or {}",
                  sequence.folder.string(), frames, frames == 1 ? "" : "s",
                  delay->frames > 0 ? "late" : "early", delay->frames > 0 ? "later" : "earlier",
                  100 * delay->given, 100 * delay->then, delay->frames > 0 ? '+' : '-', frames,
                  RepairHint(sequence)),
              "colour-late"});
  report.mistakes.push_back(
      {"colour-late", {}, MistakeAmount{static_cast<double>(delay->frames), "frames"}});
  MoveColor(sequence, delay->frames, Correction(sequence, report));
}

bool IsInside(int frame, const std::vector<BadStretch>& stretches) {
  return std::any_of(stretches.begin(), stretches.end(), [frame](const BadStretch& stretch) {
    return frame >= stretch.first && frame <= stretch.last;
  });
}

}  // namespace

bool FitsElsewhere(const DepthViews& views, const std::vector<FramePair>& pairs,
                   const FramePoses& poses) {
  const std::vector<PoseJump> jumps = FindPoseJumps(views, poses);
  const std::vector<BadStretch> stretches = FindBadStretches(views, poses, jumps);
  std::vector<FramePair> others = pairs;
  std::erase_if(others, [&](const FramePair& pair) {
    const bool crosses = std::any_of(jumps.begin(), jumps.end(), [&](const PoseJump& jump) {
      return jump.frame >= pair.from && jump.frame < pair.to;
    });
    return crosses || IsInside(pair.from, stretches) || IsInside(pair.to, stretches);
  });
  if (others.size() == pairs.size() || 2 * others.size() < pairs.size()) return false;
  const PoseAgreement agreement = MeasureAgreement(views, others, poses);
  return agreement.usable >= kMinJudgedPairs && WideResidual(others, agreement) <= kMaxWideResidual;
}

void ExamineDetails(const Sequence& sequence, const Thumbnails& thumbnails,
                    const FindingHandler& on_finding, GeometryReport& report) {
  const DepthViews views(thumbnails, sequence.depth_scale);
  const FramePoses poses = GivenPoses(sequence);
  const std::vector<PoseJump> all_jumps = FindPoseJumps(views, poses);
  ReportColorDelay(sequence, FindColorDelay(views, thumbnails, sequence.T_color_depth, poses),
                   on_finding, report);
  std::vector<PoseJump> jumps = all_jumps;
  const std::vector<Outliers> outliers = TakeOutliers(views, poses, jumps);
  ReportOutliers(sequence, outliers, all_jumps, on_finding, report);
  ReportJumps(sequence, jumps, on_finding, report);
  ReportStretches(sequence, FindBadStretches(views, poses, all_jumps), on_finding, report);
}

}  // namespace curvefusion
