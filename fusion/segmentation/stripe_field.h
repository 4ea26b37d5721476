#pragma once

#include "fusion/appearance/wire_posterior.h"
#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

/// What a pixel is to the stripes around it.
enum class StripePart {
  kPlateau,  ///< level: inside something wide, or far from everything
  kCrest,    ///< in the middle of a stripe that is more likely wire than what lies beside it
  kValley,   ///< in the middle between two such stripes
  kFlank     ///< on the way from one to the other
};

struct StripePixel {
  StripePart part = StripePart::kPlateau;
  Vec2 normal = Vec2::UnitX();  ///< unit, across the stripe; of either sign
};

/// Stripes of an image of how likely pixels show wire: its ridges and their opposite by first and
/// second derivatives at one scale (Steger 1998). Resolves stripes from about five pixels apart.
/// Deviation: CurveFusion takes depth pixels as they are; where depth is one sheet only the stripes
/// of the colour image tell where in it the wires are.
class StripeField {
 public:
  explicit StripeField(const PosteriorImage& posterior);

  /// A crest and a valley are about one pixel wide, whatever the width of the stripe. Pixels at the
  /// image's border are plateau. The pixel must lie in the image.
  StripePixel At(int u, int v) const;

 private:
  Image<float> smooth_;  ///< 0 to 1
};

}  // namespace curvefusion
