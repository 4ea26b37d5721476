#include "experiments/metrics/diameter_metrics.h"

#include <cmath>

#include "kernel/parallel.h"
#include "kernel/spatial_search.h"

namespace curvefusion {
namespace {

constexpr int64_t kGrain = 256;

// The radius of the nearest true point for each sample of known radius; 0 where none is in reach.
std::vector<double> TrueRadii(const SkeletonSamples& result, const SkeletonSamples& truth) {
  const PointIndex index(truth.positions);
  std::vector<double> radii(result.size(), 0.0);
  ParallelFor(0, static_cast<int64_t>(result.size()), kGrain, [&](int64_t i) {
    if (result.radii[i] <= 0) return;
    const int nearest = index.Nearest(result.positions[i]);
    const double distance = (truth.positions[nearest] - result.positions[i]).norm();
    if (distance <= kCurveReach) radii[i] = truth.radii[nearest];
  });
  return radii;
}

// Samples of one edge stand one after the other, and nearly 1 mm apart: they all weigh the same.
struct EdgeSum {
  EdgeDiameter sum;
  int count = 0;
  int last_sample = 0;

  EdgeDiameter Means() const {
    return {sum.edge, sum.length, sum.diameter / count, sum.true_diameter / count};
  }
};

std::vector<EdgeSum> SumByEdge(const SkeletonSamples& result, const std::vector<double>& radii) {
  std::vector<EdgeSum> sums;
  for (size_t i = 0; i < result.size(); ++i) {
    if (radii[i] <= 0) continue;
    const int sample = static_cast<int>(i);
    if (sums.empty() || sums.back().sum.edge != result.edges[i]) {
      sums.push_back({{result.edges[i], 0, 0, 0}, 0, sample});
    }
    EdgeSum& edge = sums.back();
    if (edge.last_sample == sample - 1) {
      edge.sum.length += result.arc_lengths[i] - result.arc_lengths[i - 1];
    }
    edge.sum.diameter += 2 * result.radii[i];
    edge.sum.true_diameter += 2 * radii[i];
    edge.last_sample = sample;
    ++edge.count;
  }
  return sums;
}

}  // namespace

DiameterScores CompareDiameters(const SkeletonSamples& result, const SkeletonSamples& truth) {
  DiameterScores scores;
  if (result.size() == 0 || truth.size() == 0) return scores;
  const std::vector<double> radii = TrueRadii(result, truth);
  std::vector<double> errors;
  std::vector<double> relative_errors;
  for (size_t i = 0; i < result.size(); ++i) {
    if (radii[i] <= 0) continue;
    errors.push_back(2 * std::abs(result.radii[i] - radii[i]));
    relative_errors.push_back(std::abs(result.radii[i] / radii[i] - 1));
  }
  scores.mean_error = Mean(errors);
  scores.relative_error = Mean(relative_errors);
  scores.compared_share = static_cast<double>(errors.size()) / static_cast<double>(result.size());
  for (const EdgeSum& edge : SumByEdge(result, radii)) scores.edges.push_back(edge.Means());
  return scores;
}

}  // namespace curvefusion
