#include "fusion/curve_graph/wire_proof.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "graph/connected_parts.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

// Measured: logistic regression over the stretches of training scans and real rooms
// (docs/proof.md#coefficients). First a stretch by itself,
constexpr double kBias = 0.59;
constexpr double kSame = -1.71;
constexpr double kOpen = 1.68;
constexpr double kWide = -2.44;
constexpr double kPast = -1.97;
constexpr double kMostlyPast = -2.98;
constexpr double kCovered = 3.29;
constexpr double kThick = -3.0;
// then with those around it,
struct SecondStep {
  double bias = 0, own = 0, around = 0, covered = 0;
};
constexpr SecondStep kWithColour = {-1.87, 0.07, 1.35, 4.83};
// and where colour tells nothing. Measured, but for the bias: -1.17 by an earlier fit; chosen 1.15
// higher, since what that held 15 to 30 % likely was true in .77 of its length.
constexpr SecondStep kWithoutColour = {-0.02, 0.34, 1.8, 0};

constexpr double kFewImages = 5;       // chosen: so many images count as much as knowing nothing
constexpr double kSameFloor = 0.03;    // chosen: so much of a wire's surroundings goes on by chance
constexpr double kWidestWire = 0.012;  // metres, CurveFusion 4
constexpr double kNeighbourhood = 0.25;  // metres
constexpr double kMaxLogOdds = 4;        // of one stretch for those around it
constexpr double kNothingWeight = 0.04;  // metres: so much is drawn to zero in means

// The terms of a stretch's own log-odds.
struct Terms {
  double surface = 0, thick = 0, past = 0, rest = 0;
  double Sum() const { return surface + thick + past + rest; }
};

Terms OwnTerms(const StretchEvidence& e) {
  const double w = e.images / (e.images + kFewImages);
  const double wide = std::clamp((e.width - kWidestWire) / 0.010, 0.0, 1.5);
  const double thick = std::clamp((e.diameter - kWidestWire) / 0.006, 0.0, 1.5);
  Terms terms;
  terms.surface = w * kSame * std::log((e.same + kSameFloor) / kSameFloor);
  terms.thick = w * kWide * wide + kThick * thick;
  terms.past = w * (kPast * e.past + kMostlyPast * std::clamp((e.past - 0.6) / 0.4, 0.0, 1.0));
  terms.rest = kBias + w * kOpen * e.open + kCovered * e.coverage;
  return terms;
}

// The share of a stretch on which colour shows something that measures as thin as a wire.
double CoveredByWire(const StretchEvidence& e) {
  const bool is_thin = e.diameter > 0 && e.diameter <= kWidestWire;
  return is_thin ? e.coverage : 0;
}

Doubt LargestDoubt(const Terms& terms) {
  constexpr double kClear = -1;  // less may be a wire's
  const double least = std::min({terms.surface, terms.thick, terms.past});
  if (least > kClear) return Doubt::kUnproven;
  if (least == terms.surface) return Doubt::kSurface;
  return least == terms.thick ? Doubt::kThick : Doubt::kLookedPast;
}

// Weighted by metres of curve, drawn to zero.
struct WeightedMean {
  double sum = 0, length = kNothingWeight;
  void Add(double value, double metres) {
    sum += metres * value;
    length += metres;
  }
  double Value() const { return sum / length; }
};

std::map<EdgeId, int> PartOfEdges(const SkeletonGraph& skeleton) {
  std::map<EdgeId, int> part_of;
  int part = 0;
  for (const std::vector<EdgeId>& edges : ConnectedEdges(skeleton)) {
    for (const EdgeId id : edges) part_of[id] = part;
    ++part;
  }
  return part_of;
}

}  // namespace

double Probability(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

std::vector<WireProof> ProveWires(const SkeletonGraph& skeleton,
                                  const std::vector<StretchEvidence>& evidence, bool colour_tells) {
  std::vector<WireProof> proofs;
  std::vector<double> own;
  std::vector<Vec3> middles;
  for (const StretchEvidence& stretch : evidence) {
    const Terms terms = OwnTerms(stretch);
    proofs.push_back({0, LargestDoubt(terms)});
    own.push_back(terms.Sum());
    middles.push_back(stretch.middle);
  }
  const bool has_strips = std::any_of(evidence.begin(), evidence.end(),
                                      [](const StretchEvidence& e) { return e.coverage > 0; });
  const SecondStep& step = colour_tells && has_strips ? kWithColour : kWithoutColour;
  const std::map<EdgeId, int> part_of = PartOfEdges(skeleton);
  const PointIndex index(middles);
  std::vector<int> near;
  for (size_t i = 0; i < evidence.size(); ++i) {
    index.WithinRadius(middles[i], kNeighbourhood, near);
    WeightedMean of_others, covered;
    for (const int j : near) {
      if (part_of.at(evidence[j].edge) != part_of.at(evidence[i].edge)) continue;
      const double length = evidence[j].length;
      covered.Add(CoveredByWire(evidence[j]), length);
      if (static_cast<size_t>(j) == i) continue;
      of_others.Add(std::clamp(own[j], -kMaxLogOdds, kMaxLogOdds), length);
    }
    proofs[i].log_odds = step.bias + step.own * own[i] + step.around * of_others.Value() +
                         step.covered * covered.Value();
  }
  return proofs;
}

}  // namespace curvefusion
