#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fusion/strips/strip_samples.h"
#include "kernel/image.h"

namespace curvefusion {

/// Colours across a curve (red, green, blue, 0 to 255) at steps of half a pixel along the image
/// normal, averaged along the curve.
struct StripProfile {
  static constexpr double kStepPx = 0.5;  ///< chosen: strips are found to about a step
  double first_px = 0;                    ///< offset of the first value from the projected curve
  std::vector<Eigen::Vector3f> values;

  double offset_px(int i) const { return first_px + i * kStepPx; }
};

/// Reads the profile of a sample over offsets of +-half_width_px, bilinearly, averaged over
/// +-half_length_px along the tangent.
StripProfile ReadProfile(const ColorImage& image, const ProjectedSample& sample,
                         double half_width_px, int half_length_px);

/// Where a strip lies in a profile, to about half a pixel.
struct StripPosition {
  double center_px = 0;  ///< offset from the projected curve
  double width_px = 0;
};

/// The strip that stands out most from the background on both of its sides, against the scatter
/// within the three; linear shading across the strip does not count as scatter. Looks at centres
/// within +-search_px and widths up to max_width_px. Nothing where the colours differ by less than
/// min_contrast (grey levels) on either side.
std::optional<StripPosition> FindStrip(const StripProfile& profile, double search_px,
                                       double max_width_px, double min_contrast);

/// How far beside a strip its profile must reach for MeasureStrip, in pixels. Derived: the 3 px
/// that blur carries its colour, and 2 px of background.
inline constexpr double kStripMarginPx = 5;

/// What the colours of a strip say of its width whatever the blur: blur moves colour across the
/// edges, but the integral of what the strip takes away from the background stays.
struct StripColors {
  Eigen::Vector3d mass;        ///< integral of background minus profile, grey levels x px
  Eigen::Vector3d background;  ///< where the strip hides it: the mean of both sides
  Eigen::Vector3d center;      ///< colour at the centre, blurred
  Eigen::Vector3d interior;    ///< mean colour over the width, blurred
};

/// Integrates over a strip and 3 px on either side; the background is the straight line through
/// the means of the next 2 px on either side. Nothing where the profile does not reach so far.
std::optional<StripColors> MeasureStrip(const StripProfile& profile, const StripPosition& position);

/// The offset of the centroid of the difference to the background in the direction `weights`.
double StripCentroid(const StripProfile& profile, const StripPosition& position,
                     const Eigen::Vector3d& weights);

}  // namespace curvefusion
