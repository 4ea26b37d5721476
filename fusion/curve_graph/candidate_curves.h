#pragma once

#include <vector>

#include "fusion/curve_graph/candidate_proof.h"
#include "fusion/curve_graph/strip_views.h"
#include "graph/contraction/ridge_skeleton.h"
#include "graph/skeleton_graph.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// What AddCandidateCurves has added, and what it was decided by.
struct AddedCurves {
  double length = 0;  ///< metres
  std::vector<CandidateStretch> stretches;
};

/// Adds the curves of `candidates` (FindColourCandidates), contracted with `options` and moved onto
/// their strips (SnapToStrips), but for what runs along curves of the skeleton and what is not
/// proven (KeepProvenCandidates); follows all ends (TrackTips), joins them with what lies ahead
/// (CloseFreeEnds), and drops what hangs together neither with curves that were there nor with such
/// as are wires by themselves. What is new has the radius given, in metres.
AddedCurves AddCandidateCurves(const Sequence& sequence, const ObservedPoints& candidates,
                               const RidgeOptions& options, double radius, StripViews& views,
                               SkeletonGraph& skeleton);

}  // namespace curvefusion
