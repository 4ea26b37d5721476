#include "fusion/solid_parts/room_planes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>

#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Chosen: smaller planes are faces of things, not of a room (half a sheet of paper).
constexpr double kMinArea = 0.03;
constexpr double kMinCosine = 0.87;  // of 30 degrees
// One draw in (share of the plane)^3 hits; of a plane of a fifth of the surface one in 125.
constexpr int kDraws = 1000;
constexpr int kMaxPlanes = 12;
constexpr size_t kScored = 4000;  // triangles: enough to tell a share of a few percent
constexpr int kRefinements = 3;

struct Plane {
  Vec3 normal = Vec3::UnitZ();
  double offset = 0;

  bool Holds(const Vec3& center, const Vec3& triangle_normal, double tolerance) const {
    return std::abs(normal.dot(center) - offset) <= tolerance &&
           normal.dot(triangle_normal) >= kMinCosine;
  }
};

// Draws triangles by their area.
class TriangleDraw {
 public:
  TriangleDraw(const SurfaceTriangles& surface, const TriangleMarks& left) {
    double sum = 0;
    for (size_t i = 0; i < surface.size(); ++i) {
      cumulative_.push_back(sum += left[i] ? surface.areas[i] : 0);
    }
  }
  double area() const { return cumulative_.empty() ? 0 : cumulative_.back(); }
  size_t operator()(std::mt19937_64& random) const {
    const double share = static_cast<double>(random() >> 11) * 0x1.0p-53;
    const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), share * area());
    return std::min(static_cast<size_t>(found - cumulative_.begin()), cumulative_.size() - 1);
  }

 private:
  std::vector<double> cumulative_;
};

Plane PlaneThrough(const SurfaceTriangles& surface, size_t a, size_t b, size_t c) {
  const Vec3& p = surface.centers[a];
  Plane plane;
  plane.normal = (surface.centers[b] - p).cross(surface.centers[c] - p).normalized();
  if (plane.normal.dot(surface.normals[a]) < 0) plane.normal = -plane.normal;
  plane.offset = plane.normal.dot(p);
  return plane;
}

TriangleMarks Held(const SurfaceTriangles& surface, const TriangleMarks& left, const Plane& plane,
                   double tolerance) {
  TriangleMarks held(surface.size(), 0);
  for (size_t i = 0; i < surface.size(); ++i) {
    held[i] = left[i] && plane.Holds(surface.centers[i], surface.normals[i], tolerance);
  }
  return held;
}

// The plane of least squares of the marked triangles.
Plane Fitted(const SurfaceTriangles& surface, const TriangleMarks& marked, const Plane& before) {
  double area = 0;
  Vec3 sum = Vec3::Zero();
  Mat3 moments = Mat3::Zero();
  for (size_t i = 0; i < surface.size(); ++i) {
    if (!marked[i]) continue;
    const Vec3& p = surface.centers[i];
    area += surface.areas[i];
    sum += surface.areas[i] * p;
    moments += surface.areas[i] * p * p.transpose();
  }
  if (area <= 0) return before;
  const Vec3 mean = sum / area;
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(moments / area - mean * mean.transpose());
  Plane plane;
  plane.normal = axes.eigenvectors().col(0);
  if (plane.normal.dot(before.normal) < 0) plane.normal = -plane.normal;
  plane.offset = plane.normal.dot(mean);
  return plane;
}

// The plane with the most area, of many drawn ones.
Plane LargestPlane(const SurfaceTriangles& surface, const TriangleMarks& left, double tolerance,
                   std::mt19937_64& random) {
  const TriangleDraw draw(surface, left);
  std::vector<size_t> scored(kScored);
  for (size_t& i : scored) i = draw(random);
  std::vector<Plane> planes(kDraws);
  for (Plane& plane : planes) {
    plane = PlaneThrough(surface, draw(random), draw(random), draw(random));
  }
  std::vector<int> votes(kDraws, 0);
  ParallelFor(0, kDraws, 16, [&](int64_t k) {
    for (const size_t i : scored) {
      votes[k] += planes[k].Holds(surface.centers[i], surface.normals[i], tolerance) ? 1 : 0;
    }
  });
  Plane best = planes[std::max_element(votes.begin(), votes.end()) - votes.begin()];
  for (int round = 0; round < kRefinements; ++round) {
    best = Fitted(surface, Held(surface, left, best, tolerance), best);
  }
  return best;
}

}  // namespace

TriangleMarks FindRoomPlanes(const SurfaceTriangles& surface, double tolerance) {
  TriangleMarks room(surface.size(), 0);
  TriangleMarks left(surface.size(), 1);
  std::mt19937_64 random(1);
  for (int k = 0; k < kMaxPlanes && TriangleDraw(surface, left).area() > kMinArea; ++k) {
    const Plane plane = LargestPlane(surface, left, tolerance, random);
    const TriangleMarks held = Held(surface, left, plane, tolerance);
    double area = 0;
    for (const SurfacePiece& piece : PiecesOf(surface, held)) {
      area += piece.area;
      for (const int i : piece.triangles) {
        left[i] = 0;
        if (piece.is_cut) room[i] = 1;
      }
    }
    if (area < kMinArea) break;
  }
  return room;
}

}  // namespace curvefusion
