#pragma once

#include <array>
#include <optional>
#include <vector>

#include "experiments/metrics/precision_recall.h"
#include "graph/skeleton_graph.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// Points about 1 mm apart along all curves of a skeleton, and where each was taken.
struct SkeletonSamples {
  std::vector<Vec3> positions;
  std::vector<EdgeId> edges;
  std::vector<double> arc_lengths;  ///< metres from the edge's first point
  std::vector<Vec3> tangents;       ///< unit directions there; zero where undefined
  std::vector<double> lengths;      ///< metres of curve that each stands for
  std::vector<double> radii;        ///< metres; 0 where the edge has none

  size_t size() const { return positions.size(); }
};
SkeletonSamples SampleSkeleton(const SkeletonGraph& graph, double step = 1 * kMillimetre);

/// From each point the distance to the nearest of `others` (not empty), in parallel.
std::vector<double> DistancesTo(const std::vector<Vec3>& points, const std::vector<Vec3>& others);

/// At which distances a curve counts as found.
inline constexpr std::array<double, 4> kDistanceThresholds = {1 * kMillimetre, 2 * kMillimetre,
                                                              5 * kMillimetre, 10 * kMillimetre};

/// Farther from the truth than this a curve is false, farther from the result it is missing: the
/// widest threshold (chosen: twice the thickest wires of the paper's objects).
inline constexpr double kCurveReach = 10 * kMillimetre;

/// How near a result's curves are to the true ones and these to them.
struct DistanceScores {
  std::array<PrecisionRecall, kDistanceThresholds.size()> within;  ///< of kDistanceThresholds
  std::optional<double> mean;           ///< mean of both directions' means, metres
  std::optional<double> percentile_95;  ///< the greater one of both directions', metres
  double false_length = 0;    ///< metres of the result farther than kCurveReach from the truth
  double missing_length = 0;  ///< metres of the truth farther than kCurveReach from the result
};

/// Compares samples of the result with samples of the truth. Either may be empty.
DistanceScores CompareCurves(const SkeletonSamples& result, const SkeletonSamples& truth);

}  // namespace curvefusion
