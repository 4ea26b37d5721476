#include "fusion/curve_graph/wire_proof.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "graph/connected_parts.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

// Fitted: logistic regression over the stretches of training scans and real rooms
// (docs/proof.md#coefficients). First a stretch by itself,
constexpr double kBias = 0.59;
constexpr double kSame = -1.71;
constexpr double kOpen = 1.68;
constexpr double kWide = -2.44;
constexpr double kPast = -1.97;
constexpr double kMostlyPast = -2.98;
constexpr double kCovered = 3.29;
constexpr double kThick = -3.0;
// with what colour shows beside it, as far as that tells, fitted to 31 training scans,
constexpr double kToldByColour = 0.18;
constexpr double kOpenInColour = 2.53;
constexpr double kLessOfTheRest = 0.58;  // of the terms above, thickness aside
// then with those around it, fitted to log-odds of models that had not seen the scan's family.
constexpr double kAroundBias = -1.17;
constexpr double kOwn = 0.34;
constexpr double kAround = 1.8;

constexpr double kFewImages = 5;       // chosen: so many images count as much as knowing nothing
constexpr double kSameFloor = 0.03;    // chosen: so much of a wire's surroundings goes on by chance
constexpr double kWidestWire = 0.012;  // metres, CurveFusion 5
constexpr double kNeighbourhood = 0.25;  // metres; chosen: few wires end within centimetres
constexpr double kTellingChange = 5;     // grey levels; chosen: noise of smoothed pixels is 1 to 2
constexpr double kOpenRatio = 0.7;       // chosen: log of most over least change, so much is open
constexpr double kOverSurfaces = 2;      // chosen: weight of the change over that on surfaces
constexpr double kFarOverSurfaces = 1;   // chosen: log of e times the change on surfaces
constexpr double kLeastOpen = -1.3;      // chosen: less tells no more
constexpr double kMaxLogOdds = 4;        // chosen: of one stretch for those around it
// Of the length. Chosen: results of 18 scans of wires have .63 and more, what is left of two rooms
// .32 and .57 (docs/lab_notebook.md).
constexpr double kMinWireShare = 0.55;
constexpr double kOwnWeight = 0.04;  // metres: of the neighbours' mean, shrunk towards zero

// The terms of a stretch's own log-odds.
struct Terms {
  double surface = 0, thick = 0, past = 0, rest = 0;
  double told_by_colour = 0;  // 0 to 1
  double colour = 0;

  double Sum() const {
    return thick + (1 - kLessOfTheRest * told_by_colour) * (surface + past + rest) + colour;
  }
};

// Whether colours beside a stretch change in all directions, compared to surfaces, which poses and
// exposure make change, and to the direction in which they change most: positive where it is open
// all around. What changes far more than surfaces is open, however much another direction changes.
double OpenInColour(const StretchEvidence& e) {
  const double of_surfaces = std::log((e.beside.least + 1) / (e.on_surfaces + 1));
  const double excess = e.on_surfaces > 0 ? std::max(0.0, of_surfaces - kFarOverSurfaces) : 0;
  const double most_over_least = std::log((e.beside.most + 1) / (e.beside.least + 1));
  const double of_most = kOpenRatio - std::max(0.0, most_over_least - excess);
  return std::max(kLeastOpen, std::min(of_most, kOverSurfaces * of_surfaces));
}

double ToldByColour(const StretchEvidence& e) {
  const double telling = e.beside.most * e.beside.most;
  return telling / (telling + kTellingChange * kTellingChange);
}

Terms OwnTerms(const StretchEvidence& e) {
  const double w = e.images / (e.images + kFewImages);
  const double wide = std::clamp((e.width - kWidestWire) / 0.010, 0.0, 1.5);
  const double thick = std::clamp((e.diameter - kWidestWire) / 0.006, 0.0, 1.5);
  Terms terms;
  terms.surface = w * kSame * std::log((e.same + kSameFloor) / kSameFloor);
  terms.thick = w * kWide * wide + kThick * thick;
  terms.past = w * (kPast * e.past + kMostlyPast * std::clamp((e.past - 0.6) / 0.4, 0.0, 1.0));
  terms.told_by_colour = ToldByColour(e);
  terms.colour = ColourLogOdds(e);
  terms.rest = kBias + w * kOpen * e.open + kCovered * e.coverage;
  return terms;
}

Doubt LargestDoubt(const Terms& terms) {
  constexpr double kClear = -1;  // chosen: less may be a wire's
  const double surface = terms.surface + std::min(0.0, terms.colour);
  const double least = std::min({surface, terms.thick, terms.past});
  if (least > kClear) return Doubt::kUnproven;
  if (least == surface) return Doubt::kSurface;
  return least == terms.thick ? Doubt::kThick : Doubt::kLookedPast;
}

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

double ColourLogOdds(const StretchEvidence& evidence) {
  return ToldByColour(evidence) * (kToldByColour + kOpenInColour * OpenInColour(evidence));
}

double Probability(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

bool IsHardlyWire(double wire_length, double length) {
  return length > 0 && wire_length < kMinWireShare * length;
}

std::vector<WireProof> ProveWires(const SkeletonGraph& skeleton,
                                  const std::vector<StretchEvidence>& evidence,
                                  const std::vector<RefutedStretch>& refuted) {
  const std::map<EdgeId, int> part_of = PartOfEdges(skeleton);
  std::vector<WireProof> proofs;
  std::vector<Vec3> middles;
  for (const StretchEvidence& stretch : evidence) {
    const Terms terms = OwnTerms(stretch);
    proofs.push_back({0, LargestDoubt(terms), terms.Sum(), part_of.at(stretch.edge)});
    middles.push_back(stretch.middle);
  }
  const PointIndex index(middles);
  std::vector<int> near;
  for (size_t i = 0; i < evidence.size(); ++i) {
    double sum = 0, length = kOwnWeight;
    const auto add = [&sum, &length](double of_length, double own_log_odds) {
      sum += of_length * std::clamp(own_log_odds, -kMaxLogOdds, kMaxLogOdds);
      length += of_length;
    };
    index.WithinRadius(middles[i], kNeighbourhood, near);
    for (const int j : near) {
      const bool is_other = static_cast<size_t>(j) != i;
      if (is_other && proofs[j].part == proofs[i].part)
        add(evidence[j].length, proofs[j].own_log_odds);
    }
    for (const RefutedStretch& stretch : refuted) {
      if ((stretch.middle - middles[i]).norm() < kNeighbourhood)
        add(stretch.length, stretch.own_log_odds);
    }
    proofs[i].log_odds = kAroundBias + kOwn * proofs[i].own_log_odds + kAround * sum / length;
  }
  return proofs;
}

}  // namespace curvefusion
