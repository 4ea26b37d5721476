#include "experiments/metrics/curve_metrics.h"

#include <algorithm>
#include <numeric>

#include "kernel/parallel.h"
#include "kernel/spatial_search.h"

namespace curvefusion {
namespace {

constexpr int64_t kGrain = 256;  // queries per chunk of a parallel loop

// Linear between the values at the vertices.
double ValueAt(const std::vector<double>& values, const std::vector<double>& cumulative_length,
               double arc_length) {
  const auto next =
      std::upper_bound(cumulative_length.begin(), cumulative_length.end(), arc_length);
  if (next == cumulative_length.end()) return values.back();
  const size_t i = static_cast<size_t>(next - cumulative_length.begin());
  const double t =
      (arc_length - cumulative_length[i - 1]) / (cumulative_length[i] - cumulative_length[i - 1]);
  return values[i - 1] + t * (values[i] - values[i - 1]);
}

void AppendSamples(const SkeletonGraph& graph, EdgeId id, double step, SkeletonSamples& samples) {
  const SkeletonEdge& edge = graph.edge(id);
  const std::vector<double> cumulative = CumulativeLength(edge.points);
  const Polyline points = Resample(edge.points, step);
  const std::vector<Vec3> tangents = Tangents(points);
  const double spacing = cumulative.back() / static_cast<double>(points.size() - 1);
  for (size_t i = 0; i < points.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(points.size() - 1);
    const double arc_length = share * cumulative.back();
    samples.positions.push_back(points[i]);
    samples.tangents.push_back(tangents[i]);
    samples.edges.push_back(id);
    samples.arc_lengths.push_back(arc_length);
    const bool is_end = i == 0 || i + 1 == points.size();
    samples.lengths.push_back(is_end ? spacing / 2 : spacing);
    samples.radii.push_back(edge.radii.empty() ? 0 : ValueAt(edge.radii, cumulative, arc_length));
  }
}

std::vector<int> NearestIndices(const std::vector<Vec3>& points, const PointIndex& index) {
  std::vector<int> nearest(points.size());
  ParallelFor(0, static_cast<int64_t>(points.size()), kGrain,
              [&](int64_t i) { nearest[i] = index.Nearest(points[i]); });
  return nearest;
}

std::vector<double> PairDistances(const std::vector<Vec3>& points, const std::vector<Vec3>& others,
                                  const std::vector<int>& pairs) {
  std::vector<double> distances(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    distances[i] = (points[i] - others[pairs[i]]).norm();
  }
  return distances;
}

double LengthBeyond(const SkeletonSamples& samples, const std::vector<double>& distances) {
  double length = 0;
  for (size_t i = 0; i < samples.size(); ++i) {
    if (distances[i] > kCurveReach) length += samples.lengths[i];
  }
  return length;
}

}  // namespace

SkeletonSamples SampleSkeleton(const SkeletonGraph& graph, double step) {
  SkeletonSamples samples;
  for (const EdgeId edge : graph.Edges()) AppendSamples(graph, edge, step, samples);
  return samples;
}

std::vector<double> DistancesTo(const std::vector<Vec3>& points, const std::vector<Vec3>& others) {
  return PairDistances(points, others, NearestIndices(points, PointIndex(others)));
}

DistanceScores CompareCurves(const SkeletonSamples& result, const SkeletonSamples& truth) {
  DistanceScores scores;
  if (result.size() == 0 && truth.size() == 0) return scores;
  if (result.size() == 0 || truth.size() == 0) {
    for (PrecisionRecall& score : scores.within) {
      (truth.size() == 0 ? score.precision : score.recall) = 0;
    }
    scores.false_length = std::accumulate(result.lengths.begin(), result.lengths.end(), 0.0);
    scores.missing_length = std::accumulate(truth.lengths.begin(), truth.lengths.end(), 0.0);
    return scores;
  }
  const std::vector<double> to_truth = DistancesTo(result.positions, truth.positions);
  const std::vector<double> to_result = DistancesTo(truth.positions, result.positions);
  for (size_t i = 0; i < kDistanceThresholds.size(); ++i) {
    scores.within[i] = {ShareWithin(to_truth, {}, kDistanceThresholds[i]),
                        ShareWithin(to_result, {}, kDistanceThresholds[i])};
  }
  scores.false_length = LengthBeyond(result, to_truth);
  scores.missing_length = LengthBeyond(truth, to_result);
  scores.mean = (*Mean(to_truth) + *Mean(to_result)) / 2;
  scores.percentile_95 = std::max(Percentile(to_truth, 0.95), Percentile(to_result, 0.95));
  return scores;
}

}  // namespace curvefusion
