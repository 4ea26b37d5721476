#include "meshing/tube_normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/box_pairs.h"

namespace curvefusion {

namespace {

// A tube's polygons reach so much farther than its radius, mitred corners included.
constexpr double kReach = 1.2;
// A triangle lies on a tube if its middle is off by less than this part of the radius, and turned
// by less than about 45 degrees: the sum of both, the turn as 1 - cosine.
constexpr double kGreatestMisfit = 0.3;
// Corners share a normal where theirs differ by less than 6 degrees: at the rings of a bend they
// differ by nothing, at seams that can be seen by more.
const double kMinCosShared = std::cos(0.1);

// A segment of a tube, with the normals of the planes of the rings at its ends.
struct Segment {
  Vec3 a, b;
  Vec3 plane_a, plane_b;
  double radius_a, radius_b;
  bool starts, finishes;  // the tube
};

std::vector<Segment> SegmentsOf(const std::vector<TubePath>& paths) {
  std::vector<Segment> segments;
  for (const TubePath& path : paths) {
    const Polyline& p = path.axis.points;
    const size_t n = p.size();
    const auto count = static_cast<size_t>(path.segment_count());
    const auto direction = [&](size_t i) { return Vec3((p[(i + 1) % n] - p[i]).normalized()); };
    for (size_t i = 0; i < count; ++i) {
      const bool starts = !path.closed && i == 0;
      const bool finishes = !path.closed && i + 1 == count;
      const Vec3 before = starts ? direction(i) : direction((i + n - 1) % n);
      const Vec3 after = finishes ? direction(i) : direction((i + 1) % n);
      const size_t j = (i + 1) % n;
      segments.push_back({p[i], p[j], (before + direction(i)).normalized(),
                          (direction(i) + after).normalized(), path.axis.radii[i],
                          path.axis.radii[j], starts, finishes});
    }
  }
  return segments;
}

// Where on a segment, 0 at a and 1 at b, the plane lies that holds a point, or beyond it; planes
// turn from that of one ring to that of the other.
double PlaneThrough(const Segment& s, const Vec3& p) {
  const Vec3 axis = s.b - s.a;
  double t = (p - s.a).dot(axis) / axis.squaredNorm();
  for (int round = 0; round < 3; ++round) {
    const Vec3 normal = (1 - t) * s.plane_a + t * s.plane_b;
    const double slope = normal.dot(axis);
    if (slope <= 0) break;
    t += normal.dot(p - s.a - t * axis) / slope;
    t = std::clamp(t, -1.0, 2.0);
  }
  return t;
}

// The normal of the round tube at a point near its surface, and how far that is off, in radii:
// outwards, inwards, or beyond the last ring of the segment.
struct TubeNormal {
  Vec3 normal;
  double offset;
};

TubeNormal NormalAt(const Segment& s, const Vec3& p) {
  const double plane = PlaneThrough(s, p);
  const double t = std::clamp(plane, 0.0, 1.0);
  const Vec3 axis = s.b - s.a;
  const double length = axis.norm();
  const double radius = s.radius_a + t * (s.radius_b - s.radius_a);
  const Vec3 out = p - s.a - t * axis;
  const double distance = out.norm();
  if (distance == 0) return {Vec3::UnitZ(), 1};
  const bool on_dome = (t == 0 && s.starts) || (t == 1 && s.finishes);
  const Vec3 lean =
      on_dome ? Vec3(Vec3::Zero()) : Vec3((s.radius_b - s.radius_a) / (length * length) * axis);
  const double beyond = on_dome ? 0 : std::abs(plane - t) * length / radius;
  return {(out / distance - lean).normalized(), std::abs(distance / radius - 1) + beyond};
}

// The segment on whose tube every triangle lies; -1 where on none.
class Ownership {
 public:
  Ownership(const TriangleMesh& mesh, const std::vector<Segment>& segments)
      : mesh_(mesh), segments_(segments) {}

  std::vector<int> Find() const {
    std::vector<Eigen::AlignedBox3d> tubes, middles;
    for (const Segment& s : segments_) {
      const Vec3 reach = Vec3::Constant(kReach * std::max(s.radius_a, s.radius_b));
      tubes.emplace_back(Vec3(s.a.cwiseMin(s.b) - reach), Vec3(s.a.cwiseMax(s.b) + reach));
    }
    for (size_t f = 0; f < mesh_.triangles.size(); ++f) middles.emplace_back(MiddleOf(f));
    std::vector<int> owner(mesh_.triangles.size(), -1);
    std::vector<double> least(mesh_.triangles.size(), kGreatestMisfit);
    for (const auto& [segment, face] : BoxTree(tubes).OverlappingPairs(middles)) {
      const double misfit = Misfit(face, segments_[segment]);
      if (misfit >= least[face]) continue;
      least[face] = misfit;
      owner[face] = segment;
    }
    return owner;
  }

  Vec3 Corner(size_t face, int k) const {
    return mesh_.vertices[mesh_.triangles[face][k]].cast<double>();
  }

  Vec3 FaceNormal(size_t face) const {
    const Vec3 normal =
        (Corner(face, 1) - Corner(face, 0)).cross(Corner(face, 2) - Corner(face, 0));
    return normal.isZero(0) ? Vec3(Vec3::UnitZ()) : Vec3(normal.normalized());
  }

 private:
  Vec3 MiddleOf(size_t face) const {
    return (Corner(face, 0) + Corner(face, 1) + Corner(face, 2)) / 3;
  }

  double Misfit(size_t face, const Segment& segment) const {
    const TubeNormal there = NormalAt(segment, MiddleOf(face));
    return there.offset + 1 - there.normal.dot(FaceNormal(face));
  }

  const TriangleMesh& mesh_;
  const std::vector<Segment>& segments_;
};

// Gives corners of one vertex with nearly the same normal one index; the normal is that of the
// first of them.
class SharedNormals {
 public:
  explicit SharedNormals(const TriangleMesh& mesh) : of_vertex_(mesh.vertices.size()) {}

  int IndexOf(int vertex, const Vec3& normal) {
    for (const int index : of_vertex_[vertex]) {
      if (normals_[index].cast<double>().dot(normal) > kMinCosShared) return index;
    }
    of_vertex_[vertex].push_back(static_cast<int>(normals_.size()));
    normals_.push_back(normal.cast<float>());
    return of_vertex_[vertex].back();
  }

  std::vector<Vec3f>& normals() { return normals_; }

 private:
  std::vector<std::vector<int>> of_vertex_;
  std::vector<Vec3f> normals_;
};

}  // namespace

CornerNormals ComputeTubeNormals(const TriangleMesh& mesh, const std::vector<TubePath>& paths) {
  const std::vector<Segment> segments = SegmentsOf(paths);
  const Ownership ownership(mesh, segments);
  const std::vector<int> owner = ownership.Find();
  SharedNormals shared(mesh);
  CornerNormals result;
  result.of_corner.resize(mesh.triangles.size());
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 normal = owner[face] < 0
                              ? ownership.FaceNormal(face)
                              : NormalAt(segments[owner[face]], ownership.Corner(face, k)).normal;
      result.of_corner[face][k] = shared.IndexOf(mesh.triangles[face][k], normal);
    }
  }
  result.normals = std::move(shared.normals());
  return result;
}

}  // namespace curvefusion
