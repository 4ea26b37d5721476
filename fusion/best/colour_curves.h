#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "capture/sequence.h"
#include "fusion/adjustment/colour_adjustment.h"
#include "fusion/appearance/wire_posterior.h"
#include "fusion/best/best_options.h"
#include "fusion/curve_graph/strip_views.h"
#include "fusion/reconstruction.h"
#include "fusion/segmentation/colour_gate.h"
#include "fusion/stage_progress.h"

namespace curvefusion {

/// The name of the stage in reports.
inline constexpr const char* kWiresFromColour = "wires from colour";

/// So many images tell where wires are, at most: as many as StripViews looks at.
inline constexpr int kColourImages = StripViews::kMaxViews;

/// Images and how likely their pixels show wire.
struct WireImages {
  std::vector<int> frames;
  std::vector<PosteriorImage> posteriors;
};

/// By the colours of wires. At most 90 images. Throws Error(kBadInput) where one cannot be read.
WireImages LookForColours(const Sequence& sequence, const WireColours& colours);

/// Where no colours are known: by what stands out from its surroundings (LocalContrast) and is no
/// wider than the strips that StripViews finds, in images of half the size that it looks at.
/// Likewise.
WireImages LookForContrast(const Sequence& sequence);

/// What colour images gave, and what it is to be adjusted from again.
struct ColourCurves {
  ColourAdjustment adjusted;
  AdjustmentStart start;
};

/// Curves and poses from colour images, in rounds: places that the images agree on `around` the
/// object are contracted, and curves and poses adjusted to the images; with these poses and the
/// colours then learned all of that once more. Depth says what stands before or behind a place.
/// Where there is none, the first round looks at images of half the size, in which given poses err
/// by half as many pixels, and the second one around what the first one found. Where `thin` is
/// given, places are sought only in pixels around which it has points of something thin (at
/// whatever distance), must be found from half of the images, and only what strips then prove
/// stays: little, but right, to which rounds add the rest. `images` are those to begin with, in the
/// end those with the colours learned last. Curves, points, radii and poses are those of `colour`.
/// Nothing where no curve can be fitted.
std::optional<ColourCurves> FitCurvesOfColour(
    const Sequence& sequence, const AdjustmentStart& start, Eigen::AlignedBox3d around,
    const Reconstruction* thin, const BestOptions& options, const StageReporter& reporter,
    WireImages& images, Reconstruction& colour);

}  // namespace curvefusion
