#include "fusion/solid_parts/contact_faces.h"

#include <algorithm>
#include <array>

namespace curvefusion {

namespace {

// Share of a piece's triangles that may lie behind a plane it stands on. Chosen: noise puts some
// there.
constexpr double kMaxBehind = 0.02;

double Cross(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

// Counter-clockwise (Andrew 1979).
std::vector<Vec2> ConvexHull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) {
    return std::array{a.x(), a.y()} < std::array{b.x(), b.y()};
  });
  std::vector<Vec2> hull;
  for (int side = 0; side < 2; ++side) {
    const size_t start = hull.size();
    for (const Vec2& p : points) {
      while (hull.size() >= start + 2 && Cross(hull[hull.size() - 2], hull.back(), p) <= 0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    if (!hull.empty()) hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

// The centres of a piece's triangles near a plane; none where it reaches through.
std::vector<Vec3> ContactsOf(const SurfaceTriangles& surface, const SurfacePiece& piece,
                             const RoomPlane& plane, double reach) {
  std::vector<Vec3> contacts;
  size_t behind = 0;
  for (const int i : piece.triangles) {
    const double height = plane.normal.dot(surface.centers[i]) - plane.offset;
    behind += height < -reach ? 1 : 0;
    if (std::abs(height) <= reach) contacts.push_back(surface.centers[i]);
  }
  const bool through =
      static_cast<double>(behind) > kMaxBehind * static_cast<double>(piece.triangles.size());
  return through ? std::vector<Vec3>() : contacts;
}

void AppendHull(const std::vector<Vec3>& points, const RoomPlane& plane, TriangleMesh& faces) {
  const Vec3 x = plane.normal.unitOrthogonal(), y = plane.normal.cross(x);
  std::vector<Vec2> flat;
  for (const Vec3& p : points) flat.emplace_back(x.dot(p), y.dot(p));
  const std::vector<Vec2> hull = ConvexHull(std::move(flat));
  const int first = static_cast<int>(faces.vertices.size());
  for (const Vec2& p : hull) {
    faces.vertices.push_back((p.x() * x + p.y() * y + plane.offset * plane.normal).cast<float>());
  }
  for (int k = 2; k < static_cast<int>(hull.size()); ++k) {
    faces.triangles.push_back({first, first + k - 1, first + k});
  }
}

}  // namespace

TriangleMesh ContactFaces(const SurfaceTriangles& surface, const TriangleMarks& marked,
                          const std::vector<RoomPlane>& planes, double reach) {
  TriangleMesh faces;
  for (const SurfacePiece& piece : PiecesOf(surface, marked)) {
    for (const RoomPlane& plane : planes) {
      const std::vector<Vec3> contacts = ContactsOf(surface, piece, plane, reach);
      if (contacts.size() >= 3) AppendHull(contacts, plane, faces);
    }
  }
  return faces;
}

}  // namespace curvefusion
