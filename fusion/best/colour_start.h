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
  kNoHelp,     ///< nor do they tell the wires' colours, or where the object is
  kMisplaced,  ///< depth was measured to scatter about the wires that images show
};

/// Deviation: curves and poses from colour images alone, for cameras whose depth shows wires in
/// wrong places. Depth still tells where the object is (result.points), what stands before or
/// behind a place (FindColourCandidates), and by its thin pixels the wires' colours (`colours`).
/// Places that images agree on are contracted, and curves and poses adjusted to the images (`given`
/// has the poses that are started from, which err as told); with the poses and colours then learned
/// all of that once more. Scale is left to HoldToScaleOfDepth.
///
/// Places are sought in these ways, until curves from them replace curves, points, radii and poses
/// of the result. Of the first two, those curves are taken in whose pixels more of the points lie
/// that depth has of something thin:
/// - in pixels around which depth has such points: of what is proven there the images must show a
///   greater share as wire than of depth's curves, and half of those points must lie in pixels of
///   it. It may be little: a start;
/// - in whole images: these must show more metres as wire, metres that they do not show taken off,
///   than of depth's curves; where those are only doubtful, also more without taking any off, as
///   images that hardly show depth's curves may hardly show wires at all. Most of the new curves
///   must lie in pixels in which depth shows something thin, as what is painted on surfaces does
///   not;
/// - last, in whole images again, but as depth may not show them at all, strips are followed from
///   place to place, and depth must show something behind nearly all of them.
/// Where depth shows no wire, or is of no help, only the latter two are tried, where most cameras
/// look, and depth must show something behind nearly all of them. Where it shows no wire no more is
/// asked: the proof decides. With DepthRole::kBackground those from whole images are taken wherever
/// there are any. Without colours places are sought in what stands out from its surroundings.
/// Nothing otherwise.
/// Throws Error(kBadInput) for an image that cannot be read. Costs about .1 s an image, at most 90
/// of them.
std::optional<ColourCurves> StartFromColour(const Sequence& given, PoseErrors pose_errors,
                                            const WireColours& colours, DepthCurves depth_curves,
                                            const BestOptions& options,
                                            const StageReporter& reporter, Reconstruction& result);

/// Deviation: depth's curves (with radii, as nothing was adjusted yet) and poses fitted to the
/// images alone. Where a camera shows wires too far away, poses bend until these agree with images
/// and depth; from poses held to surfaces (`given`) images show where they are. Replaces curves and
/// poses of the result; nothing where a strip is seen at less than a tenth of the places looked at.
/// Scale is left to HoldToScaleOfDepth. `colours` as for AdjustmentStart. Throws like
/// StartFromColour.
std::optional<ColourCurves> FitToColourAlone(SkeletonGraph depth_curves, const Sequence& given,
                                             PoseErrors pose_errors,
                                             const std::vector<uint8_t>& colours,
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
