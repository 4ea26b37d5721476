#pragma once

#include <optional>
#include <string>
#include <vector>

#include "capture/content/depth_agreement.h"
#include "capture/content/pose_hypotheses.h"

namespace curvefusion {

/// What a search for the cause of a misfit looks at.
struct MisfitEvidence {
  const Thumbnails& thumbnails;
  double depth_scale = 1000;
  std::vector<FramePair> pairs;
  FramePoses poses;            ///< as given
  std::vector<double> times;   ///< of the frames, where they have any
  Trajectory trajectory = {};  ///< with times; empty where poses belong to frames by number
  double frame_period = 1;     ///< seconds with a trajectory
};

/// One family of causes with its best member.
struct PoseExplanation {
  std::string cause;
  std::string description;
  FramePoses poses;         ///< that fit
  bool swap_bytes = false;  ///< of the depth
  double value = 0;         ///< factor of translations; frames, or seconds with a trajectory, by
                            ///< which the poses are late
  PoseAgreement agreement;
  bool is_fine = false;  ///< so small a change that more evidence is asked for
};

/// What fits better than the poses as given.
struct PoseSearch {
  PoseAgreement given;
  std::optional<PoseExplanation> best;  ///< only where it is much and surely better
};

/// Tries every hypothesis. The best explains the misfit where its cost is at most 0.6 of that of
/// the poses as given, nearly all pairs agree, and no other family comes near.
PoseSearch ExplainMisfit(const MisfitEvidence& evidence);

/// Whether the poses as given fit, and better than poses somewhat earlier, later, farther or nearer
/// do: then nothing is to be explained. Costs a tenth of ExplainMisfit.
bool FitsAsGiven(const MisfitEvidence& evidence, const PoseAgreement& given);

/// Chosen: frames between which errors of poses have grown.
inline constexpr int kWideGap = 10;

/// Median residual of the pairs of kWideGap and more frames, or of all where too few can be judged.
double WideResidual(const std::vector<FramePair>& pairs, const PoseAgreement& agreement);

/// The greatest such residual of usable poses, relative to distance.
inline constexpr double kMaxWideResidual = 0.04;

}  // namespace curvefusion
