#include "experiments/metrics/curve_metrics.h"

#include <Eigen/SVD>
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
  const double spacing = cumulative.back() / static_cast<double>(points.size() - 1);
  for (size_t i = 0; i < points.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(points.size() - 1);
    const double arc_length = share * cumulative.back();
    samples.positions.push_back(points[i]);
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
    if (distances[i] > kReach) length += samples.lengths[i];
  }
  return length;
}

// The rigid motion from source to target with the least sum of squares (Kabsch 1976).
RigidTransform FitRigidMotion(const std::vector<Vec3>& source, const std::vector<Vec3>& target) {
  const double count = static_cast<double>(source.size());
  const Vec3 source_mean =
      std::accumulate(source.begin(), source.end(), Vec3(Vec3::Zero())) / count;
  const Vec3 target_mean =
      std::accumulate(target.begin(), target.end(), Vec3(Vec3::Zero())) / count;
  Mat3 covariance = Mat3::Zero();
  for (size_t i = 0; i < source.size(); ++i) {
    covariance += (source[i] - source_mean) * (target[i] - target_mean).transpose();
  }
  const Eigen::JacobiSVD<Mat3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double handedness = svd.matrixU().determinant() * svd.matrixV().determinant();
  const Vec3 signs(1, 1, handedness < 0 ? -1 : 1);
  RigidTransform T_target_source = RigidTransform::Identity();
  T_target_source.linear() = svd.matrixV() * signs.asDiagonal() * svd.matrixU().transpose();
  T_target_source.translation() = target_mean - T_target_source.linear() * source_mean;
  return T_target_source;
}

// One round of iterative closest points.
RigidTransform RefineAlignment(const std::vector<Vec3>& result, const std::vector<Vec3>& truth,
                               const PointIndex& index, const RigidTransform& T_truth_result) {
  constexpr double kTrim = 0.8;
  constexpr double kAlwaysKept = 2 * kMillimetre;
  std::vector<Vec3> moved(result.size());
  std::transform(result.begin(), result.end(), moved.begin(),
                 [&](const Vec3& p) { return T_truth_result * p; });
  const std::vector<int> pairs = NearestIndices(moved, index);
  const std::vector<double> distances = PairDistances(moved, truth, pairs);
  const double gate = std::max(Percentile(distances, kTrim), kAlwaysKept);
  std::vector<Vec3> source;
  std::vector<Vec3> target;
  for (size_t i = 0; i < result.size(); ++i) {
    if (distances[i] >= gate) continue;
    source.push_back(result[i]);
    target.push_back(truth[pairs[i]]);
  }
  return source.empty() ? T_truth_result : FitRigidMotion(source, target);
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

RigidTransform AlignToTruth(const std::vector<Vec3>& result, const std::vector<Vec3>& truth) {
  constexpr size_t kFewestPoints = 11;
  constexpr int kIterations = 60;
  constexpr double kAtRest = 1e-13;  // no further round would change the pairs
  RigidTransform T_truth_result = RigidTransform::Identity();
  if (result.size() < kFewestPoints || truth.empty()) return T_truth_result;
  const PointIndex index(truth);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const RigidTransform next = RefineAlignment(result, truth, index, T_truth_result);
    const double change = (next.matrix() - T_truth_result.matrix()).norm();
    T_truth_result = next;
    if (change < kAtRest) break;
  }
  return T_truth_result;
}

}  // namespace curvefusion
