#include "fusion/silhouettes/colour_pruning.h"

#include <optional>
#include <vector>

#include "capture/frame_stream.h"
#include "fusion/appearance/wire_posterior.h"
#include "fusion/curve_graph/refuted_parts.h"
#include "fusion/silhouettes/wire_silhouettes.h"

namespace curvefusion {

std::optional<double> PruneByColour(const Sequence& sequence, const WireColours& colours,
                                    const SilhouetteOptions& options, SkeletonGraph& skeleton) {
  const std::vector<int> frames = EvenlyThinned(AllFrames(sequence), options.max_frames);
  std::vector<PosteriorImage> posteriors;
  ForEachFrame(sequence, frames, {.depth = false, .color = true}, [&](const DecodedFrame& frame) {
    posteriors.push_back(ApplyPosterior(BinColours(frame.color), colours.posterior));
  });
  Sequence shifted = sequence;
  shifted.color_camera.cx += colours.shift_px.x();
  shifted.color_camera.cy += colours.shift_px.y();
  const WireSilhouettes silhouettes(shifted, frames, posteriors, options.max_frames);
  if (!TellWires(silhouettes, skeleton)) return std::nullopt;
  return DropRefutedParts(
      [&silhouettes](const Polyline& points) { return silhouettes.SharesAlong(points, 1); },
      options.min_share, {}, skeleton);
}

}  // namespace curvefusion
