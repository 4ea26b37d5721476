#pragma once

#include <cstdint>

#include "fusion/appearance/wire_posterior.h"
#include "kernel/image.h"

namespace curvefusion {

/// The pixels in the middle of strips.
struct StripPixels {
  MaskImage middles;          // 1 at them
  Image<uint8_t> directions;  // which way the strip runs there, see DirectionUnits; 0 elsewhere
};

/// Strips that stand out from both sides: where the contrast is greatest across. Of several widths,
/// as wires are; none where `posterior` says background. Images of one size. About 60 ms for 640 x
/// 480 pixels.
StripPixels FindStripPixels(const ColorImage& color, const PosteriorImage& posterior);

/// Angles of undirected lines in an image, from its rows: 256 to half a turn.
uint8_t DirectionUnits(double angle);

}  // namespace curvefusion
