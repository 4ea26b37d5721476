#pragma once

#include <vector>

#include "fusion/curve_graph/stretch_evidence.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// What speaks most against a stretch being a wire.
enum class Doubt {
  kUnproven,    ///< nothing in particular: too little speaks for it
  kSurface,     ///< on one side of it a surface goes on
  kThick,       ///< wider than any wire
  kLookedPast,  ///< depth images measured what is behind it
};

/// Whether a stretch is a wire.
struct WireProof {
  double log_odds = 0;  ///< that it is one, natural logarithm; candidates are as often wires as not
  Doubt doubt = Doubt::kUnproven;
  double own_log_odds = 0;  ///< by its own evidence only
  int part = 0;             ///< number of its connected part of the skeleton
};

/// A stretch that left a connected part of which something stayed.
struct RefutedStretch {
  Vec3 middle;        ///< metres
  double length = 0;  ///< metres
  double own_log_odds = 0;
};

/// 1 / (1 + exp(-log_odds)).
double Probability(double log_odds);

/// What the colours beside a stretch add to its log-odds; 0 where they tell nothing.
double ColourLogOdds(const StretchEvidence& evidence);

/// Judges every stretch by its own evidence and by that of the stretches around it on the same
/// connected part of the skeleton: few wires end within some centimetres, and what hides one
/// stretch rarely hides those beside it. On validation scans medium probabilities are too low: of
/// stretches given .90 all are wires, of those given .58 a share of .98 (docs/proof.md). `evidence`
/// is CollectEvidence of the skeleton; what an earlier proof `refuted` still counts around the
/// stretches that it left: what is a wire where much beside it is none, is one rarely. Cost: n log
/// n.
std::vector<WireProof> ProveWires(const SkeletonGraph& skeleton,
                                  const std::vector<StretchEvidence>& evidence,
                                  const std::vector<RefutedStretch>& refuted);

/// Whether so little of `length` metres of curve is wire that most of what looks like wires there
/// is none.
bool IsHardlyWire(double wire_length, double length);

}  // namespace curvefusion
