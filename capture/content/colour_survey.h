#pragma once

#include "capture/sequence.h"

namespace curvefusion {

/// What the colour images of a sequence are like as stored: figures of some frames.
struct ColourSurvey {
  int frames = 0;            ///< looked at
  double brightness = 0;     ///< median over the frames of their median grey level, 0 to 255
  double bright_share = 0;   ///< median share of pixels of 250 or more
  double contrast = 0;       ///< median standard deviation of the grey levels, smoothed by 2 px
  double chroma = 0;         ///< mean difference of a pixel's largest and smallest channel
  double blurred_share = 0;  ///< of the frames that are much less sharp than the sharp ones
  double sharpness = 0;      ///< median; 1 = steps of a pixel, .11 = ramps of 6 px of 320

  /// Nothing stands out from anything: constant, black or wholly over-exposed images.
  bool IsFeatureless() const;
  /// Grey images: there are edges, but no colours to tell wires by.
  bool IsGrey() const;
};

/// Of at most `max_frames` evenly spread frames, in parallel; images that cannot be read are left
/// out. About 5 ms an image besides its decoding.
ColourSurvey SurveyColour(const Sequence& sequence, int max_frames);

}  // namespace curvefusion
