#pragma once

#include "capture/content/geometry_check.h"
#include "capture/content/pose_hypotheses.h"

namespace curvefusion {

/// For poses that fit on the whole: reports single jumps of the trajectory, bad stretches, and
/// colour that is late against depth. Adds to the report's correction what can be mended: colour
/// moved by some frames, and single frames with a wrong pose left out.
void ExamineDetails(const Sequence& sequence, const Thumbnails& thumbnails,
                    const FindingHandler& on_finding, GeometryReport& report);

/// Whether poses that do not fit on the whole do so where no jump is crossed and no frame of a bad
/// stretch looked at, over at least half of the pairs: then ExamineDetails tells what is wrong.
bool FitsElsewhere(const DepthViews& views, const std::vector<FramePair>& pairs,
                   const FramePoses& poses);

}  // namespace curvefusion
