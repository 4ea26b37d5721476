#pragma once

#include <optional>

#include "capture/sequence.h"
#include "fusion/best/best_options.h"
#include "fusion/best/colour_curves.h"
#include "fusion/reconstruction.h"
#include "fusion/segmentation/colour_gate.h"
#include "fusion/stage_progress.h"

namespace curvefusion {

/// What is known of depth's curves.
enum class DepthCurves {
  kNone,       ///< depth shows no wire
  kDoubtful,   ///< images do not fit them
  kMisplaced,  ///< depth was measured to scatter about the wires that images show
};

/// Deviation: curves and poses from colour images alone, for cameras whose depth shows wires in
/// wrong places. Depth still tells where the object is (result.points), what stands before or
/// behind a place (FindColourCandidates), and by its thin pixels the wires' colours (`colours`).
/// Places that images agree on are contracted, and curves and poses adjusted to the images (`given`
/// has the poses that are started from, which err as told); with the poses and colours then learned
/// all of that once more. Scale is left to HoldToScaleOfDepth.
///
/// Replaces curves, points, radii and poses of the result where the images show more metres of the
/// new curves as wire than of those that were there, metres that they do not show taken off; where
/// these are only doubtful, also more without taking any off: images that hardly show depth's
/// curves may hardly show wires at all. Most of the new curves must lie in pixels in which depth
/// shows something thin, as wires do and what is painted on surfaces does not; or depth, which then
/// does not show them at all, must show something behind nearly all of them, and strips are
/// followed from place to place. Where depth shows no wire it must show something behind nearly all
/// of them, and no more is asked: the proof decides. With DepthRole::kBackground wherever there are
/// any. Where depth has shown nothing thin, places are sought where most cameras look, in what
/// stands out from its surroundings. Nothing otherwise.
/// Throws Error(kBadInput) for an image that cannot be read. Costs about .1 s an image, at most 90
/// of them.
std::optional<ColourCurves> StartFromColour(const Sequence& given, PoseErrors pose_errors,
                                            const WireColours& colours, DepthCurves depth_curves,
                                            const BestOptions& options,
                                            const StageReporter& reporter, Reconstruction& result);

/// Curves and poses from colour images and poses alone: what stands out from its surroundings,
/// where most cameras look (RegionSeenByMost), as FitCurvesOfColour does it without depth. Scale is
/// that of the poses. Sets curves, points, radii and poses of the result; nothing where images
/// agree on no proven curve. Throws and costs like StartFromColour.
std::optional<ColourCurves> StartWithoutDepth(const Sequence& given, const BestOptions& options,
                                              const StageReporter& reporter,
                                              Reconstruction& result);

}  // namespace curvefusion
