#pragma once

#include <optional>

#include "capture/sequence.h"
#include "graph/skeleton_graph.h"
#include "kernel/image.h"

namespace curvefusion {

/// The frame whose colour camera sees most of the graph; among equals the one that sees it largest.
/// Parts hidden by other things count as seen. -1 for a sequence without frames.
/// Costs frames times graph length.
int FrameSeeingMost(const SkeletonGraph& graph, const Sequence& sequence);

/// The colour image of a frame with the tubes of the graph drawn into it, see-through, cut to the
/// part that shows the graph; each edge in a colour of its own, or all in the one given.
ColorImage DrawFrameOverlay(const SkeletonGraph& graph, const Sequence& sequence, int frame,
                            int width, int height, const std::optional<Rgb>& color = std::nullopt);

}  // namespace curvefusion
