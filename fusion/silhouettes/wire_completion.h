#pragma once

#include "capture/sequence.h"
#include "graph/branch_continuations.h"
#include "graph/skeleton_graph.h"
#include "kernel/options.h"

namespace curvefusion {

/// When a wire that depth has missed is believed from the colour images.
struct WireCompletionOptions {
  bool enabled = false;
  int max_frames = 60;
  int rounds = 8;
  double step = 0.003;
  double search_px = 4;
  double max_offset_px = 2.5;
  int min_looks = 2;
  double min_share = 0.2;
  int min_seen = 5;
  double min_places = 0.6;
  ContinuationOptions continuations;
};
void VisitOptions(WireCompletionOptions& options, OptionVisitor& visitor);

/// The skeleton with what was added to it.
struct CompletedWires {
  SkeletonGraph skeleton;
  int added = 0;     ///< edges
  int rejected = 0;  ///< ways ahead on which the images show no wire, in the last round
};

/// Adds wires that depth has missed where the colour images show them. The sensor loses thin wires
/// that run along its line of sight long before they vanish in colour. Ways ahead of branches that
/// end (FindContinuations) are looked up in the images of `sequence`, whose poses must be those of
/// the skeleton: on most places of the way, wherever no other curve is in the way, strips of the
/// wires' colour and width must stand out from both sides, about as often as on curves known
/// before. What is added may be continued in the next round. Nothing is added where curves have no
/// radii. Deviation: CurveFusion uses colour for ghosts and radii only. Throws Error(kBadInput) for
/// images that cannot be decoded. Cost: 20 ms a frame used for 3 m of wire.
CompletedWires CompleteWires(const SkeletonGraph& skeleton, const Sequence& sequence,
                             const WireCompletionOptions& options);

}  // namespace curvefusion
