#pragma once

#include <vector>

#include "capture/sequence.h"
#include "fusion/adjustment/color_shift.h"
#include "fusion/adjustment/colour_frames.h"

namespace curvefusion {

/// What the depth images say of curves that are adjusted to colour images: how far away they are,
/// and how the colour images lie against the depth images.
struct DepthGauge {
  std::vector<AxisDepthObservation> depths;
  /// The middles of what depth shows across the wires, in its pixels: where both sides end.
  std::vector<StripObservation> centres;
  double sigma = 0;        ///< of a single one against the curves, metres
  double scatter = 0;      ///< the same in standard deviations of a plane's depth as far away
  ColorShift color_shift;  ///< to be added to the colour camera's principal point, in its pixels
};

/// Looks up the depth at the strips of the frames `indices`; where colour shows none that is
/// accepted, at the curve's place, and only what ends on both sides counts. Depth is measured on
/// the near side of wires, `axis_depth` radii before the axis. Depths off by more than three
/// standard deviations (at least 8 mm, at most 60 mm) are not those of the wire. Throws
/// Error(kBadInput) for an image that cannot be decoded.
DepthGauge MeasureDepthGauge(const Sequence& sequence, const std::vector<int>& indices,
                             const CurveVertices& curves, const CurvePoseState& state,
                             const std::vector<FrameStrips>& strips, double axis_depth);

}  // namespace curvefusion
