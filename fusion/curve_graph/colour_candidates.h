#pragma once

#include <vector>

#include "capture/sequence.h"
#include "fusion/appearance/wire_posterior.h"
#include "graph/skeleton_graph.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// Places of wires that the colour images show and no curve explains: thin wires that depth loses.
/// In some images, pixels in the middle of thin strips of wire colour that no curve of `skeleton`
/// covers are followed along their lines of sight; a place counts where nearly all images that look
/// at it show the middle of a strip there as well, and where depth shows something farther behind
/// it. Nothing for a line of sight on which two places do so, or many in a row, as along wires that
/// the camera moves along. `skeleton` (with radii), poses and colour camera of `sequence` must fit
/// the images; `posteriors` tell for each of `frames` how likely its pixels are to show wire.
/// Counts are those of the images that agree. Decodes depth images, and throws Error(kBadInput)
/// like LoadDepth. Costs about 50 ns for each unexplained pixel, depth and view.
ObservedPoints FindColourCandidates(const SkeletonGraph& skeleton, const Sequence& sequence,
                                    const std::vector<int>& frames,
                                    const std::vector<PosteriorImage>& posteriors);

}  // namespace curvefusion
