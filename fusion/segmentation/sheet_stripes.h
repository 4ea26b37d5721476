#pragma once

#include <vector>

#include "fusion/segmentation/colour_gate.h"

namespace curvefusion {

/// What colours show of sheets of depth.
struct SheetStripes {
  double share = 0;  ///< of the sheets' area that is straight stripes side by side
  double spacing =
      0;             ///< metres from the middle of one stripe to the next, the usual one; 0 = none
  double width = 0;  ///< metres, of a stripe, roughly: where wire is likelier than background
};

/// Looks in the wire arrays of frames for straight parallel stripes of wire colour, up to
/// `max_spacing` (metres) from one another: wire arrays have them all over, boards with a texture
/// hardly any. Linear in pixels.
SheetStripes MeasureStripes(const std::vector<WireCandidates>& frames, const WireColours& colours,
                            const Sequence& sequence, double max_spacing);

}  // namespace curvefusion
