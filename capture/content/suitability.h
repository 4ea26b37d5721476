#pragma once

#include "capture/content/colour_survey.h"
#include "capture/finding.h"
#include "capture/image_survey.h"
#include "capture/sequence.h"

namespace curvefusion {

/// Warns of what makes a sound sequence unfit for thin wires, and says what it will cost the
/// result: cameras that cannot be ("intrinsics-implausible"), lens distortion
/// ("distortion-undone"), few frames ("too-few-frames"), a camera that stands ("static-camera") or
/// sees from one side only
/// ("path-too-short"), distance ("too-far"), little depth ("depth-sparse"), and colour that is dark
/// ("too-dark"), over-exposed ("over-exposed") or blurred ("motion-blur").
void ReportSuitability(const Sequence& sequence, const DepthSurvey& depth,
                       const ColourSurvey& colour, const FindingHandler& on_finding);

}  // namespace curvefusion
