#pragma once

#include <string>

#include "capture/content/colour_camera.h"
#include "capture/finding.h"
#include "capture/sequence.h"

namespace curvefusion {

/// "colour lies 27 px beside depth ...; fitted: f ..., centre ..., offset ...".
std::string DescribeColourCamera(const ColourCameraFit& fit);

/// A camera as intrinsics.json holds it: `"color_camera": {...}, "T_color_depth": [...]`.
std::string ColourCameraJson(const PinholeCamera& color_camera,
                             const RigidTransform& T_color_depth);

/// Warns ("colour-misregistered") where the images are, with the lines to write.
void ReportColourCamera(const Sequence& sequence, const ColourCameraFit& fit,
                        const FindingHandler& on_finding);

/// Gives the sequence the fitted camera where colour is misregistered, and a warning that says so.
/// Returns whether it did.
bool UseFittedColourCamera(Sequence& sequence);

}  // namespace curvefusion
