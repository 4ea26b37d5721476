#pragma once

#include <optional>
#include <vector>

#include "capture/sequence.h"
#include "fusion/best/best_options.h"
#include "fusion/reconstruction.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Rounds in which colour adds wires, at most. Chosen on training scans of random families and of
/// the paper's objects (docs/lab_notebook.md).
inline constexpr int kColourRounds = 6;

/// What a run has found so far; 0 = not yet known.
struct RunSize {
  double points = 0;             ///< of all bundles
  double length = 0;             ///< metres of curve
  std::optional<int> free_ends;  ///< of the curves
  bool holds_poses = false;      ///< whether those of all frames are held to surfaces
  bool by_colour = false;        ///< whether curves are sought in colour images alone
  int rounds = 0;                ///< of colour after the first one that have begun
  bool has_last_round = false;   ///< whether no round follows these

  /// The curves found are these.
  void SetCurves(const SkeletonGraph& skeleton);
};

/// The stages of ReconstructBest in their order and what they cost for a scan of this many frames
/// and pixels, as far as the size of what is found is known. How many rounds of colour there will
/// be is not: those that have not begun cost what they take times how likely they are, by the
/// number of free ends. The stages are the same whatever is known; only costs differ.
std::vector<PlannedStage> PlanBest(const Sequence& sequence, const BestOptions& options,
                                   const RunSize& size);

/// The stages of SegmentBest, which segments this share of all bundles.
std::vector<PlannedStage> PlanSegmentation(const Sequence& sequence, const BestOptions& options,
                                           double share);

}  // namespace curvefusion
