#pragma once

#include <cstddef>
#include <vector>

#include "capture/finding.h"
#include "capture/sequence.h"

namespace curvefusion {

/// Sizes of the images of a sequence: those of the first readable one of each kind.
struct ImageSizes {
  int depth_width = 0;
  int depth_height = 0;
  int color_width = 0;
  int color_height = 0;
};

/// Looks at the headers of all images of a sequence and reports, one finding a kind of defect with
/// the files it concerns: missing, truncated or foreign files, depth that is not 16-bit grey, mixed
/// sizes, sizes that are not those of the intrinsics. Decodes nothing: about 20 us an image.
ImageSizes SurveyImages(const Sequence& sequence, const FindingHandler& on_finding);

/// Figures of the valid pixels of some depth images.
struct DepthSurvey {
  double median = 0;    ///< metres; 0 where no pixel is valid
  double near = 0;      ///< metres, that a tenth of the valid pixels are nearer than
  double validity = 0;  ///< share of valid pixels
};

/// Depths picked from images at a fixed stride, for their statistics.
struct DepthSamples {
  std::vector<float> valid;  ///< metres
  size_t pixels = 0;         ///< looked at, valid or not

  void Add(const DepthImage& image);
  void Add(const DepthSamples& other);
};

DepthSurvey SurveyDepth(DepthSamples samples);

/// Reports a median depth outside 0.1 to 10 m, naming the usual depth scale that would make it
/// plausible, and depth without any valid pixel.
void ReportDepthScale(const Sequence& sequence, const DepthSurvey& survey,
                      const FindingHandler& on_finding);

}  // namespace curvefusion
