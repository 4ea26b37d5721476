#pragma once

#include "fusion/appearance/wire_posterior.h"
#include "kernel/image.h"

namespace curvefusion {

/// 1 at pixels in the middle of strips that stand out from both sides: where the contrast is
/// greatest across. Of several widths, as wires are; none where `posterior` says background. What
/// `explained` marks is neither a strip nor beside one. Images of one size. About 60 ms for 640 x
/// 480 pixels.
MaskImage StripMiddles(const ColorImage& color, const PosteriorImage& posterior,
                       const MaskImage& explained);

/// Angles of undirected lines in an image, from its rows: 256 to half a turn.
uint8_t DirectionUnits(double angle);

/// Of middles of strips, which way these run in the image; zero elsewhere.
Image<uint8_t> StripDirections(const ColorImage& color, const MaskImage& middles);

}  // namespace curvefusion
