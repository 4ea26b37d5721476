#pragma once

#include <vector>

#include "fusion/curve_graph/stretch_evidence.h"
#include "fusion/curve_graph/wire_proof.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Metres of curve that were no proven wires, by what spoke most against them.
struct UnprovenLengths {
  double surface = 0;      ///< edges of surfaces
  double thick = 0;        ///< wider than wires
  double looked_past = 0;  ///< depth images look past them
  double unproven = 0;     ///< too little speaks for them

  double Sum() const { return surface + thick + looked_past + unproven; }
};

/// What was taken out of a skeleton.
struct UncertainCurves {
  SkeletonGraph graph;
  UnprovenLengths lengths;
  std::vector<RefutedStretch> beside_kept;  ///< those of connected parts of which something stayed
};

/// The least probability with which something is kept as a wire.
struct ProofLimits {
  double usual = 0;     ///< 0 = all is kept
  double doubtful = 0;  ///< in connected parts that are hardly wire (IsHardlyWire) and hold next to
                        ///< nothing that is likely one, and in all where the whole is such; what is
                        ///< left of them must be worth more
};

/// Leaves in the skeleton what is likely enough a wire and moves the rest to `uncertain`. Along an
/// edge it decides for runs of stretches: a change from wire to no wire must be worth its cost, and
/// so must a connected part that is left. `proofs` are those of `evidence`, which is
/// CollectEvidence of the skeleton. Returns how many metres of what is left are wire by their
/// probabilities. Linear.
double KeepProven(const std::vector<StretchEvidence>& evidence,
                  const std::vector<WireProof>& proofs, const ProofLimits& limits,
                  SkeletonGraph& skeleton, UncertainCurves& uncertain);

}  // namespace curvefusion
