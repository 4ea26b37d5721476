#include "experiments/metrics/mesh_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "experiments/metrics/truth_alignment.h"
#include "kernel/parallel.h"
#include "kernel/spatial_search.h"

namespace curvefusion {
namespace {

constexpr double kAxisStep = 0.5 * kMillimetre;
constexpr double kMeshStep = 0.5 * kMillimetre;
constexpr double kRingStep = 1 * kMillimetre;
constexpr int64_t kGrain = 256;

// Points on a surface, and the area each stands for.
struct SurfaceSamples {
  std::vector<Vec3> positions;
  std::vector<double> areas;
};

// The union of the balls about the samples of the true curves.
class TrueTubes {
 public:
  explicit TrueTubes(const SkeletonGraph& truth)
      : axis_(SampleSkeleton(truth, kAxisStep)), index_(axis_.positions) {
    const auto [least, greatest] = std::minmax_element(axis_.radii.begin(), axis_.radii.end());
    radius_range_ = *greatest - *least;
  }

  // Distance from the surface, negative inside. `found` is working memory.
  double SignedDistance(const Vec3& p, std::vector<int>& found) const {
    const int nearest = index_.Nearest(p);
    double distance = (axis_.positions[nearest] - p).norm() - axis_.radii[nearest];
    if (radius_range_ <= 0) return distance;
    const double reach = (axis_.positions[nearest] - p).norm() + radius_range_;
    index_.WithinRadius(p, reach, found);
    for (const int i : found) {
      distance = std::min(distance, (axis_.positions[i] - p).norm() - axis_.radii[i]);
    }
    return distance;
  }

  std::vector<double> SignedDistances(const std::vector<Vec3>& points) const {
    std::vector<double> distances(points.size());
    ParallelChunks(0, static_cast<int64_t>(points.size()), kGrain,
                   [&](int64_t first, int64_t last) {
                     std::vector<int> found;
                     for (int64_t i = first; i < last; ++i)
                       distances[i] = SignedDistance(points[i], found);
                   });
    return distances;
  }

 private:
  SkeletonSamples axis_;
  PointIndex index_;
  double radius_range_ = 0;
};

double Area(const std::array<Vec3, 3>& triangle) {
  return (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).norm() / 2;
}

// Samples a triangle in rows along its longest side.
void AppendSamples(std::array<Vec3, 3> triangle, SurfaceSamples& samples) {
  const auto side = [&](int i) { return (triangle[(i + 1) % 3] - triangle[i]).norm(); };
  int longest = 0;
  for (const int i : {1, 2}) longest = side(i) > side(longest) ? i : longest;
  std::rotate(triangle.begin(), triangle.begin() + longest, triangle.end());
  const double base = side(0);
  const double area = Area(triangle);
  if (area <= 0) return;
  const int rows = static_cast<int>(std::ceil(2 * area / base / kMeshStep));
  for (int row = 0; row < rows; ++row) {
    const double v = (row + 0.5) / rows;
    const int count = static_cast<int>(std::ceil((1 - v) * base / kMeshStep));
    const double row_area = area * 2 * (1 - v) / rows;
    for (int k = 0; k < count; ++k) {
      const double u = (1 - v) * (k + 0.5) / count;
      samples.positions.push_back(triangle[0] + u * (triangle[1] - triangle[0]) +
                                  v * (triangle[2] - triangle[0]));
      samples.areas.push_back(row_area / count);
    }
  }
}

SurfaceSamples SampleMesh(const TriangleMesh& mesh) {
  SurfaceSamples samples;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) AppendSamples(CornersOf(mesh, i), samples);
  return samples;
}

// A ring of points around a point of an axis.
void AppendRing(const Vec3& center, const Vec3& tangent, double radius, double axis_length,
                SurfaceSamples& samples) {
  const double around = 2 * std::numbers::pi * radius;
  const int count = std::max(8, static_cast<int>(std::ceil(around / kRingStep)));
  const Vec3 x = tangent.unitOrthogonal();
  const Vec3 y = tangent.cross(x);
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count;
    samples.positions.push_back(center + radius * (std::cos(angle) * x + std::sin(angle) * y));
    samples.areas.push_back(around / count * axis_length);
  }
}

SurfaceSamples SampleTubes(const SkeletonGraph& truth, const TrueTubes& tubes) {
  constexpr double kHidden = 0.2 * kMillimetre;  // deeper inside another tube is no surface
  const SkeletonSamples axis = SampleSkeleton(truth, kRingStep);
  SurfaceSamples rings;
  for (size_t begin = 0, end = 0; begin < axis.size(); begin = end) {
    while (end < axis.size() && axis.edges[end] == axis.edges[begin]) ++end;
    const Polyline points(axis.positions.begin() + static_cast<std::ptrdiff_t>(begin),
                          axis.positions.begin() + static_cast<std::ptrdiff_t>(end));
    const std::vector<Vec3> tangents = Tangents(points);
    const double step = axis.arc_lengths[end - 1] / static_cast<double>(end - begin);
    for (size_t i = 0; i < points.size(); ++i) {
      if (tangents[i].isZero()) continue;
      AppendRing(points[i], tangents[i], axis.radii[begin + i], step, rings);
    }
  }
  const std::vector<double> depth = tubes.SignedDistances(rings.positions);
  SurfaceSamples visible;
  for (size_t i = 0; i < depth.size(); ++i) {
    if (depth[i] < -kHidden) continue;
    visible.positions.push_back(rings.positions[i]);
    visible.areas.push_back(rings.areas[i]);
  }
  return visible;
}

double WeightedMean(const std::vector<double>& values, const std::vector<double>& weights) {
  double sum = 0;
  double total = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    sum += weights[i] * values[i];
    total += weights[i];
  }
  return sum / total;
}

SurfaceScores ScoresOfEmpty(bool mesh_is_empty, bool truth_is_empty) {
  SurfaceScores scores;
  for (PrecisionRecall& score : scores.within) {
    if (!mesh_is_empty) score.precision = 0;
    if (!truth_is_empty) score.recall = 0;
  }
  return scores;
}

}  // namespace

SurfaceScores CompareSurface(const TriangleMesh& mesh, const SkeletonGraph& truth) {
  const SurfaceSamples surface = SampleMesh(mesh);
  if (surface.positions.empty() || truth.empty()) {
    return ScoresOfEmpty(surface.positions.empty(), truth.empty());
  }
  const TrueTubes tubes(truth);
  std::vector<double> to_truth = tubes.SignedDistances(surface.positions);
  for (double& distance : to_truth) distance = std::abs(distance);
  const SurfaceSamples visible = SampleTubes(truth, tubes);
  const std::vector<double> to_mesh = DistancesTo(visible.positions, surface.positions);
  SurfaceScores scores;
  for (size_t i = 0; i < kDistanceThresholds.size(); ++i) {
    scores.within[i] = {ShareWithin(to_truth, surface.areas, kDistanceThresholds[i]),
                        ShareWithin(to_mesh, visible.areas, kDistanceThresholds[i])};
  }
  scores.mean_to_truth = WeightedMean(to_truth, surface.areas);
  scores.mean_to_mesh = WeightedMean(to_mesh, visible.areas);
  return scores;
}

RigidTransform AlignSurfaceToTruth(const TriangleMesh& mesh, const SkeletonGraph& truth) {
  constexpr size_t kSamples =
      200000;  // those of 3 m of 5 mm wire; of a whole table some 2 mm apart
  const std::vector<Vec3> surface = Thinned(SampleMesh(mesh).positions, kSamples);
  if (surface.empty() || truth.empty()) return RigidTransform::Identity();
  const SurfaceSamples visible = SampleTubes(truth, TrueTubes(truth));
  return AlignToTruth({surface, {}}, {visible.positions, {}});
}

MeshPart PartAroundTruth(const TriangleMesh& mesh, const SkeletonGraph& truth) {
  constexpr double kMargin = 30 * kMillimetre;
  Eigen::AlignedBox3d bounds;
  for (const EdgeId id : truth.Edges()) {
    const SkeletonEdge& edge = truth.edge(id);
    for (size_t i = 0; i < edge.points.size(); ++i) {
      const Vec3 reach = Vec3::Constant(edge.radii[i] + kMargin);
      bounds.extend(Eigen::AlignedBox3d(edge.points[i] - reach, edge.points[i] + reach));
    }
  }
  MeshPart part;
  part.mesh.vertices = mesh.vertices;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::array<Vec3, 3> corners = CornersOf(mesh, i);
    const bool inside = bounds.contains((corners[0] + corners[1] + corners[2]) / 3);
    if (inside) {
      part.mesh.triangles.push_back(mesh.triangles[i]);
    } else {
      part.area_outside += Area(corners);
    }
  }
  return part;
}

TriangleMesh Transformed(const TriangleMesh& mesh, const RigidTransform& T) {
  TriangleMesh moved = mesh;
  for (Vec3f& vertex : moved.vertices) vertex = (T * vertex.cast<double>()).cast<float>();
  return moved;
}

}  // namespace curvefusion
