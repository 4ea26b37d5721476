#pragma once

#include <optional>
#include <vector>

#include "fusion/appearance/wire_posterior.h"
#include "fusion/strips/strip_samples.h"

namespace curvefusion {

/// A strip that shows background on both sides.
struct WholeStrip {
  Vec2 centre;          ///< where it was found, pixels
  Vec2 normal;          ///< unit, across it
  double width_px = 0;  ///< expected
};

/// How far beyond half the expected width edges are found in one image, pixels, on average: by
/// blur, and where radii are wrong. Measured on both edges of strips found in it; nothing where
/// fewer than 30 show both.
std::optional<double> MeasureEdgeExcess(const PosteriorImage& posterior,
                                        std::vector<WholeStrip> whole);

/// The offset of a strip's centre from the projected curve along the sample's normal, pixels, by
/// the edges on those sides that are clear of other curves: a bar with a wire array on one side
/// shows no strip of its own anywhere. It lies in the middle of two edges, or half a width and
/// `excess_px` from one. Edges are looked for within search_px; nothing where one does not stand
/// out, another is nearly as good, or two are not a width apart. `sample` must have been projected
/// with StripSight::by_side. Ten times less precise than a whole strip.
std::optional<double> FindCentreByEdges(const PosteriorImage& posterior,
                                        const ProjectedSample& sample, double radius,
                                        double excess_px, double search_px);

}  // namespace curvefusion
