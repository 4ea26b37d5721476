#pragma once

#include <vector>

#include "fusion/strips/radius.h"
#include "fusion/strips/strip_profile.h"
#include "fusion/strips/strip_samples.h"

namespace curvefusion {

/// A strip found near the projection of a curve sample.
struct FoundStrip {
  int frame = 0;  ///< in sequence.frames
  ProjectedSample sample;
  StripProfile profile;
  StripPosition position;
};

/// Looks for the strip of each sample in a colour image, across the curve. Left out are samples
/// without one and those whose strip lies elsewhere than most strips of the same edge in this
/// image: an error of the pose moves all of them alike. Parallel over samples.
std::vector<FoundStrip> FindStrips(const ColorImage& image, int frame,
                                   const std::vector<ProjectedSample>& samples,
                                   const RadiusOptions& options);

/// The diameters of strips from their colours: estimates the wires' colour from all strips and
/// their backgrounds, solves each width with it, and repeats with the better widths. Left out are
/// strips that the wire's colour does not explain and those with another curve within 1.5 widths.
/// Deviation from CurveFusion 4.3: nothing is thresholded and no edge is located, so the width is
/// unbiased where a wire is a few pixels wide and shaded.
std::vector<StripWidth> SolveStripWidths(std::vector<FoundStrip> strips,
                                         const RadiusOptions& options);

/// The value that most diameters agree on: middle of the fullest bin, smoothed over three bins; 0
/// for no values.
double MostProminent(const std::vector<double>& values, double bin);

}  // namespace curvefusion
