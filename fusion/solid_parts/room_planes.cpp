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
// Chosen. A share of (share of the plane)^3 of the draws hits: of a plane of a fifth of the surface
// one in 125.
constexpr int kDraws = 1000;
constexpr int kMaxPlanes = 12;
constexpr size_t kScored = 4000;  // triangles: enough to tell a share of a few percent
constexpr int kRefinements = 3;

bool Holds(const RoomPlane& plane, const SurfaceTriangles& surface, size_t i, double tolerance) {
  return std::abs(plane.normal.dot(surface.centers[i]) - plane.offset) <= tolerance &&
         plane.normal.dot(surface.normals[i]) >= kMinCosine;
}

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

RoomPlane PlaneThrough(const SurfaceTriangles& surface, size_t a, size_t b, size_t c) {
  const Vec3& p = surface.centers[a];
  RoomPlane plane;
  plane.normal = (surface.centers[b] - p).cross(surface.centers[c] - p).normalized();
  if (plane.normal.dot(surface.normals[a]) < 0) plane.normal = -plane.normal;
  plane.offset = plane.normal.dot(p);
  return plane;
}

TriangleMarks Held(const SurfaceTriangles& surface, const TriangleMarks& left,
                   const RoomPlane& plane, double tolerance) {
  TriangleMarks held(surface.size(), 0);
  for (size_t i = 0; i < surface.size(); ++i) {
    held[i] = left[i] && Holds(plane, surface, i, tolerance);
  }
  return held;
}

// The plane of least squares of the marked triangles.
RoomPlane Fitted(const SurfaceTriangles& surface, const TriangleMarks& marked,
                 const RoomPlane& before) {
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
  RoomPlane plane;
  plane.normal = axes.eigenvectors().col(0);
  if (plane.normal.dot(before.normal) < 0) plane.normal = -plane.normal;
  plane.offset = plane.normal.dot(mean);
  return plane;
}

// The plane with the most area, of many drawn ones.
RoomPlane LargestPlane(const SurfaceTriangles& surface, const TriangleMarks& left, double tolerance,
                       std::mt19937_64& random) {
  const TriangleDraw draw(surface, left);
  std::vector<size_t> scored(kScored);
  for (size_t& i : scored) i = draw(random);
  std::vector<RoomPlane> planes(kDraws);
  for (RoomPlane& plane : planes) {
    plane = PlaneThrough(surface, draw(random), draw(random), draw(random));
  }
  std::vector<int> votes(kDraws, 0);
  ParallelFor(0, kDraws, 16, [&](int64_t k) {
    for (const size_t i : scored) {
      votes[k] += Holds(planes[k], surface, i, tolerance) ? 1 : 0;
    }
  });
  RoomPlane best = planes[std::max_element(votes.begin(), votes.end()) - votes.begin()];
  for (int round = 0; round < kRefinements; ++round) {
    best = Fitted(surface, Held(surface, left, best, tolerance), best);
  }
  return best;
}

}  // namespace

RoomPlanes FindRoomPlanes(const SurfaceTriangles& surface, double tolerance) {
  RoomPlanes room{{}, TriangleMarks(surface.size(), 0)};
  TriangleMarks left(surface.size(), 1);
  std::mt19937_64 random(1);
  for (int k = 0; k < kMaxPlanes && TriangleDraw(surface, left).area() > kMinArea; ++k) {
    const RoomPlane plane = LargestPlane(surface, left, tolerance, random);
    const TriangleMarks held = Held(surface, left, plane, tolerance);
    double area = 0;
    bool is_room = false;
    for (const SurfacePiece& piece : PiecesOf(surface, held)) {
      area += piece.area;
      is_room = is_room || piece.is_cut;
      for (const int i : piece.triangles) {
        left[i] = 0;
        if (piece.is_cut) room.marks[i] = static_cast<char>(room.planes.size() + 1);
      }
    }
    if (is_room) room.planes.push_back(plane);
    if (area < kMinArea) break;
  }
  return room;
}

TriangleMesh FlatRoom(const TriangleMesh& mesh, const RoomPlanes& room) {
  TriangleMesh flat;
  for (size_t k = 0; k < room.planes.size(); ++k) {
    const RoomPlane& plane = room.planes[k];
    TriangleMarks marks;
    for (const char mark : room.marks) marks.push_back(mark == static_cast<char>(k + 1));
    TriangleMesh part = MarkedPart(mesh, marks);
    for (Vec3f& v : part.vertices) {
      const Vec3 p = v.cast<double>();
      v = (p - (plane.normal.dot(p) - plane.offset) * plane.normal).cast<float>();
    }
    Append(part, flat);
  }
  return flat;
}

}  // namespace curvefusion
