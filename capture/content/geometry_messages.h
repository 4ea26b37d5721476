#pragma once

#include <string>

#include "capture/content/geometry_check.h"
#include "capture/content/pose_explanation.h"
#include "capture/finding.h"

namespace curvefusion {

/// A misfit whose cause is known.
struct Misfit {
  CheckFinding finding;
  PoseExplanation explanation;
  std::string remedy;      ///< what a correction changes
  FramePoses poses;        ///< right ones
  double depth_scale = 0;  ///< right one
  std::optional<MistakeAmount> amount = {};
};

/// What messages call the file that holds a sequence's cameras.
std::string IntrinsicsFile(const Sequence& sequence);

/// Puts an explanation into words, with figures as given and as they would be. Decides between
/// translations and depth where their scales do not fit each other. `search.best` must be there.
Misfit DescribeMisfit(const Sequence& sequence, const MisfitEvidence& evidence,
                      const PoseSearch& search);

/// The finding for poses that do not fit and no hypothesis explains; `residual` is that of the
/// widest pairs, `standing` the agreement of a camera that does not move.
CheckFinding UnexplainedMisfit(const Sequence& sequence, const PoseAgreement& given,
                               double residual, const PoseAgreement& standing);

/// Fewer usable pairs than that say nothing.
inline constexpr int kMinJudgedPairs = 4;

}  // namespace curvefusion
