#include "meshing/tube_normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "meshing/stubs.h"
#include "meshing/sweep.h"
#include "meshing/tubes.h"
#include "tests/meshing/tube_graphs.h"

namespace curvefusion {
namespace {

constexpr double kRadius = 0.003;

struct Shaded {
  TubeMesh tubes;
  TriangleMesh mesh;
  CornerNormals normals;

  explicit Shaded(const SkeletonGraph& graph)
      : tubes(BuildTubes(graph, {})),
        mesh(ToTriangleMesh(tubes.surface)),
        normals(ComputeTubeNormals(mesh, tubes.paths)) {}

  Vec3 Point(size_t face, int k) const {
    return mesh.vertices[mesh.triangles[face][k]].cast<double>();
  }
  Vec3 Normal(size_t face, int k) const {
    return normals.normals[normals.of_corner[face][k]].cast<double>();
  }
};

TEST(ComputeTubeNormals, AreRadialRightUpToTheSeam) {
  const Shaded cross(StarGraph({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, 0.03, kRadius));
  std::vector<std::set<int>> of_vertex(cross.mesh.vertices.size());
  double worst = 1;
  for (size_t f = 0; f < cross.mesh.triangles.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      of_vertex[cross.mesh.triangles[f][k]].insert(cross.normals.of_corner[f][k]);
      const Vec3 p = cross.Point(f, k);
      if (p.norm() > 0.03) continue;  // the rounded ends
      const Vec3 n = cross.Normal(f, k);
      const double along_x = n.dot(Vec3(0, p.y(), p.z()).normalized());
      const double along_y = n.dot(Vec3(p.x(), 0, p.z()).normalized());
      worst = std::min(worst, std::max(along_x, along_y));
    }
  }
  // Corners share a normal of at most 6 degrees from their own; the rest is float32.
  EXPECT_GT(worst, std::cos(0.11));
  // Nearly all of the seam, two ellipses, breaks: not where they cross and the tubes are level.
  const auto broken = std::count_if(of_vertex.begin(), of_vertex.end(),
                                    [](const std::set<int>& n) { return n.size() == 2; });
  EXPECT_GT(broken, 40);
}

TEST(ComputeTubeNormals, DoNotBreakAtTheRingsOfABend) {
  const double ring_radius = 4 * kRadius;
  const Shaded ring(RingGraph(ring_radius, kRadius));
  EXPECT_EQ(ring.normals.normals.size(), ring.mesh.vertices.size());
  for (size_t f = 0; f < ring.mesh.triangles.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = ring.Point(f, k);
      const Vec3 centre = ring_radius * Vec3(p.x(), p.y(), 0).normalized();
      // The axis is a polygon within .02 r of the circle.
      EXPECT_GT(ring.Normal(f, k).dot((p - centre).normalized()), std::cos(0.05));
    }
  }
}

// Rings half a radius apart at which the tube turns by .4 radians to and fro: triangles beside a
// ring are as near to the surface of the next segment as to that of their own.
TEST(ComputeTubeNormals, DoNotBreakAtTightRings) {
  TubePath path;
  Vec3 point = Vec3::Zero();
  for (int i = 0; i < 12; ++i) {
    path.axis.points.push_back(point);
    path.axis.radii.push_back(kRadius);
    const double angle = i % 4 < 2 ? 0.2 : -0.2;
    point += (i % 2 ? 0.5 : 1.5) * kRadius * Vec3(std::cos(angle), std::sin(angle), 0);
  }
  const TubeRings rings = SweepRings(path, 16, 0.1);
  const TriangleMesh mesh = CloseStub(rings, 0, path.segment_count());
  EXPECT_EQ(ComputeTubeNormals(mesh, {path}).normals.size(), mesh.vertices.size());
}

TEST(ComputeTubeNormals, TrianglesOnNoTubeHaveTheirOwn) {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const CornerNormals normals = ComputeTubeNormals(mesh, {});
  ASSERT_EQ(normals.normals.size(), 3U);
  for (const Vec3f& n : normals.normals) EXPECT_EQ(n, Vec3f(0, 0, 1));
}

TEST(ComputeTubeNormals, OfNothing) { EXPECT_TRUE(ComputeTubeNormals({}, {}).normals.empty()); }

}  // namespace
}  // namespace curvefusion
