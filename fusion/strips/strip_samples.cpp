#include "fusion/strips/strip_samples.h"

#include <algorithm>
#include <cmath>

#include "kernel/buckets.h"
#include "kernel/parallel.h"
#include "kernel/polyline.h"

namespace curvefusion {

namespace {

constexpr int64_t kGrain = 64;  // samples projected by one task; chosen, changes no result
constexpr double kMaxForeshortening = 0.9;  // chosen: beyond it curves are seen nearly end on
constexpr double kMaxClearancePx = 40;      // chosen: a strip and its background fit in
// Chosen: IsClear asks for no more beside strips up to 16 px wide; what crosses farther along
// leaves the edge beside a sample as it is.
constexpr double kMaxSideClearancePx = 16;
constexpr double kMaxSideAlongPx = 6;
// Nearer to the line of a curve another curve goes on with it, or lies behind it. Chosen on ten
// training scans (docs/lab_notebook.md#strips-found-by-their-edges).
constexpr double kInLinePx = 1.5;
constexpr double kInLineSlope = 0.25;  // of the distance along it
constexpr double kParallel = 0.7;      // cosine: 45 degrees

struct ImagePoint {
  Vec2 pixel;
  EdgeId edge = 0;
  double arc_length = 0;
  double px_per_metre = 0;
  double depth = 0;
  Vec2 tangent;  // unit; 0 where it was not wanted
};

// Projected points in square cells, for queries by distance that end where nothing nearer can come.
class PointCells {
 public:
  // Points beyond the border count too, as far as queries reach.
  PointCells(const PinholeCamera& camera, double max_distance_px)
      : border_(static_cast<int>(std::ceil(max_distance_px / kCellPx))),
        columns_(static_cast<int>(camera.width / kCellPx) + 1 + 2 * border_),
        rows_(static_cast<int>(camera.height / kCellPx) + 1 + 2 * border_) {}

  // Sorts the points into their cells.
  void Fill(const std::vector<ImagePoint>& points) {
    std::vector<int> cells;
    for (const ImagePoint& point : points)
      cells.push_back(Number(Cell(point.pixel.x()), Cell(point.pixel.y())));
    const Buckets sorted = SortIntoBuckets(cells, columns_ * rows_);
    first_ = sorted.first;
    for (const int i : sorted.members) points_.push_back(points[i]);
  }

  // Calls visit(point), ring by ring, for the points of all cells around a pixel of the image that
  // may hold one nearer than `distance_px`, which visit may lessen.
  template <class Visit>
  void VisitNearer(const Vec2& pixel, const double& distance_px, const Visit& visit) const {
    const int column = Cell(pixel.x()), row = Cell(pixel.y());
    for (int ring = 0; ring <= border_ && (ring - 1) * kCellPx < distance_px; ++ring) {
      for (int y = row - ring; y <= row + ring; ++y) {
        const bool is_edge = y == row - ring || y == row + ring;
        for (int x = column - ring; x <= column + ring; x += is_edge ? 1 : 2 * ring) {
          VisitCell(Number(x, y), visit);
        }
      }
    }
  }

 private:
  int Cell(double coordinate) const {
    return static_cast<int>(std::floor(coordinate / kCellPx)) + border_;
  }

  // -1 outside.
  int Number(int column, int row) const {
    const bool is_inside = column >= 0 && row >= 0 && column < columns_ && row < rows_;
    return is_inside ? row * columns_ + column : -1;
  }

  template <class Visit>
  void VisitCell(int cell, const Visit& visit) const {
    if (cell < 0) return;
    for (int i = first_[cell]; i < first_[cell + 1]; ++i) visit(points_[i]);
  }

  static constexpr double kCellPx = 8;  // chosen for speed: a fifth of the farthest query

  int border_;  // cells on every side of the image
  int columns_;
  int rows_;
  std::vector<int> first_;  // of each cell in points_, and the end
  std::vector<ImagePoint> points_;
};

PointCells ProjectNeighbours(const std::vector<CurveSample>& neighbours,
                             const PinholeCamera& camera, const RigidTransform& T_camera_world,
                             bool with_tangents) {
  std::vector<ImagePoint> points;
  points.reserve(neighbours.size());
  for (const CurveSample& sample : neighbours) {
    const Vec3 p = T_camera_world * sample.position;
    if (p.z() < PinholeCamera::kNearest) continue;
    points.push_back({camera.Project(p), sample.edge, sample.arc_length, camera.fx / p.z(), p.z(),
                      Vec2::Zero()});
    if (!with_tangents) continue;
    const Vec2 along = ProjectionJacobian(camera, p) * (T_camera_world.linear() * sample.tangent);
    points.back().tangent = along.normalized();
  }
  PointCells cells(camera, kMaxClearancePx);
  cells.Fill(points);
  return cells;
}

bool IsSameCurve(const ImagePoint& point, const ProjectedSample& sample, double distance_px) {
  const double along_px = std::abs(point.arc_length - sample.arc_length) * point.px_per_metre;
  // Foreshortening below .9 stretches the way along the curve 2.3 times at most.
  return point.edge == sample.edge && along_px < 3 * distance_px + 6;
}

double Clearance(const ProjectedSample& sample, const PointCells& cells, double max_along_px) {
  double clearance = kMaxClearancePx;
  cells.VisitNearer(sample.pixel, clearance, [&](const ImagePoint& point) {
    const Vec2 offset = point.pixel - sample.pixel;
    if (offset.squaredNorm() >= clearance * clearance) return;
    if (std::abs(offset.dot(sample.tangent)) > max_along_px) return;
    const double distance = offset.norm();
    if (!IsSameCurve(point, sample, distance)) clearance = distance;
  });
  return clearance;
}

std::array<double, 2> SideClearances(const ProjectedSample& sample, const PointCells& cells) {
  std::array<double, 2> clearances = {kMaxSideClearancePx, kMaxSideClearancePx};
  cells.VisitNearer(sample.pixel, kMaxSideClearancePx, [&](const ImagePoint& point) {
    const Vec2 offset = point.pixel - sample.pixel;
    const double along = std::abs(offset.dot(sample.tangent));
    if (along > kMaxSideAlongPx) return;
    const double distance = offset.norm();
    if (IsSameCurve(point, sample, distance)) return;
    const double across = offset.dot(sample.normal);
    const bool is_in_line = std::abs(across) < kInLinePx + kInLineSlope * along;
    const double behind_px = std::abs(point.depth - sample.depth) * point.px_per_metre;
    if (is_in_line && behind_px < 3 * distance + 6) return;  // goes on with it
    const bool is_parallel = std::abs(point.tangent.dot(sample.tangent)) > kParallel;
    for (const int side : {0, 1}) {
      const bool is_on_side = (across > 0) == (side == 1);
      if (!is_on_side && !is_in_line && !is_parallel) continue;
      clearances[side] = std::min(clearances[side], distance);
    }
  });
  return clearances;
}

// Fills what does not depend on other samples; false where the sample cannot be measured.
bool ProjectSample(const CurveSample& sample, const PinholeCamera& camera,
                   const RigidTransform& T_camera_world, double border_px,
                   ProjectedSample& projected) {
  const Vec3 p = T_camera_world * sample.position;
  if (p.z() < PinholeCamera::kNearest) return false;
  const Vec2 pixel = camera.Project(p);
  if (pixel.x() < border_px || pixel.y() < border_px || pixel.x() > camera.width - 1 - border_px ||
      pixel.y() > camera.height - 1 - border_px) {
    return false;
  }
  const Vec3 tangent = T_camera_world.linear() * sample.tangent;
  const Vec3 ray = p.normalized();
  if (std::abs(ray.dot(tangent)) > kMaxForeshortening) return false;
  const auto jacobian = ProjectionJacobian(camera, p);
  projected.edge = sample.edge;
  projected.arc_length = sample.arc_length;
  projected.pixel = pixel;
  projected.tangent = (jacobian * tangent).normalized();
  projected.normal = Vec2(-projected.tangent.y(), projected.tangent.x());
  projected.depth = p.z();
  // The silhouette's two lines touch the cylinder where its normal is perpendicular to axis and
  // ray.
  const Vec3 across = tangent.cross(ray).normalized();
  projected.metres_per_px = 1 / std::abs(projected.normal.dot(jacobian * across));
  return true;
}

}  // namespace

std::vector<CurveSample> SampleStrips(const SkeletonGraph& skeleton, double step) {
  std::vector<CurveSample> samples;
  for (const EdgeId edge : skeleton.Edges()) {
    const Polyline& points = skeleton.edge(edge).points;
    const std::vector<double> cumulative = CumulativeLength(points);
    const double length = cumulative.back();
    const int count = std::max(1, static_cast<int>(std::lround(length / step)));
    const double half_step = 0.5 * length / count;
    for (int i = 0; i < count; ++i) {
      const double arc_length = (2 * i + 1) * half_step;
      const Vec3 chord = PointAt(points, cumulative, arc_length + half_step) -
                         PointAt(points, cumulative, arc_length - half_step);
      if (chord.norm() <= 0) continue;
      samples.push_back(
          {edge, arc_length, PointAt(points, cumulative, arc_length), chord.normalized()});
    }
  }
  return samples;
}

Eigen::Matrix<double, 2, 3> ProjectionJacobian(const PinholeCamera& camera, const Vec3& p_camera) {
  const double x = p_camera.x() / p_camera.z();
  const double y = p_camera.y() / p_camera.z();
  Eigen::Matrix<double, 2, 3> jacobian;
  jacobian << camera.fx, 0, -camera.fx * x, 0, camera.fy, -camera.fy * y;
  return jacobian / p_camera.z();
}

std::vector<ProjectedSample> ProjectSamples(const std::vector<CurveSample>& samples,
                                            const std::vector<CurveSample>& neighbours,
                                            const PinholeCamera& camera,
                                            const RigidTransform& T_camera_world, double border_px,
                                            const StripSight& sight) {
  const PointCells cells = ProjectNeighbours(neighbours, camera, T_camera_world, sight.by_side);
  std::vector<ProjectedSample> projected(samples.size());
  ParallelFor(0, static_cast<int64_t>(samples.size()), kGrain, [&](int64_t i) {
    ProjectedSample& sample = projected[i];
    const bool is_visible = ProjectSample(samples[i], camera, T_camera_world, border_px, sample);
    sample.index = is_visible ? static_cast<int>(i) : -1;
    if (!is_visible) return;
    sample.clearance_px = Clearance(sample, cells, sight.max_along_px);
    if (sight.by_side) sample.side_clearance_px = SideClearances(sample, cells);
  });
  std::erase_if(projected, [](const ProjectedSample& sample) { return sample.index < 0; });
  return projected;
}

}  // namespace curvefusion
