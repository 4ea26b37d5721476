#include "meshing/junction_core.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

namespace curvefusion {

namespace {

// The new core begins so far inside a cut ring, in parts of the segment there; the unchanged end of
// the stub reaches twice as far and gets thinner on the way, so that the two meet at an angle.
constexpr double kCoreStart = 0.3;
constexpr double kCollarEnd = 0.6;
constexpr double kCollarTaper = 0.85;

// Where a tube is cut: the ring and the way to the next one inwards.
struct Cut {
  std::vector<Vec3f> ring;
  Vec3 centre = Vec3::Zero();
  Vec3 inwards = Vec3::Zero();
};

std::tuple<float, float, float> PlaceOf(const Vec3f& p) { return {p.x(), p.y(), p.z()}; }

Vec3 MeanOf(const std::vector<Vec3f>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3f& p : points) sum += p.cast<double>();
  return sum / static_cast<double>(points.size());
}

// The cut at a ring of one stub, whose ring vertices are marked.
Cut CutAt(const TriangleMesh& stub, const std::vector<char>& in_ring,
          const std::vector<Vec3f>& ring) {
  std::vector<Vec3f> neighbours;
  for (const auto& triangle : stub.triangles) {
    const bool touches = in_ring[triangle[0]] || in_ring[triangle[1]] || in_ring[triangle[2]];
    for (const int v : triangle) {
      if (touches && !in_ring[v]) neighbours.push_back(stub.vertices[v]);
    }
  }
  const Vec3 centre = MeanOf(ring);
  return {ring, centre, neighbours.empty() ? Vec3::Zero() : Vec3(MeanOf(neighbours) - centre)};
}

// Moves the cut rings of a stub inwards; the cuts are appended to `cuts`.
TriangleMesh Shortened(const TriangleMesh& stub, const Junction& junction, std::vector<Cut>& cuts) {
  TriangleMesh shortened = stub;
  for (const std::vector<Vec3f>& ring : junction.cut_rings) {
    std::set<std::tuple<float, float, float>> places;
    for (const Vec3f& p : ring) places.insert(PlaceOf(p));
    std::vector<char> in_ring(stub.vertices.size(), 0);
    for (size_t v = 0; v < stub.vertices.size(); ++v) {
      in_ring[v] = places.count(PlaceOf(stub.vertices[v])) > 0;
    }
    if (static_cast<size_t>(std::count(in_ring.begin(), in_ring.end(), 1)) != ring.size()) continue;
    cuts.push_back(CutAt(stub, in_ring, ring));
    const Vec3f shift = (kCoreStart * cuts.back().inwards).cast<float>();
    for (size_t v = 0; v < stub.vertices.size(); ++v) {
      if (in_ring[v]) shortened.vertices[v] += shift;
    }
  }
  return shortened;
}

// The end of a stub: a closed frustum on the ring, outward normals.
TriangleMesh Collar(const Cut& cut) {
  const int n = static_cast<int>(cut.ring.size());
  TriangleMesh collar{cut.ring, {}};
  for (const Vec3f& p : cut.ring) {
    const Vec3 inner =
        cut.centre + kCollarEnd * cut.inwards + kCollarTaper * (p.cast<double>() - cut.centre);
    collar.vertices.push_back(inner.cast<float>());
  }
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    collar.triangles.push_back({k, next, n + next});
    collar.triangles.push_back({k, n + next, n + k});
    if (k < 2) continue;
    collar.triangles.push_back({0, k, k - 1});
    collar.triangles.push_back({n, n + k - 1, n + k});
  }
  const Vec3 a = cut.ring[0].cast<double>() - cut.centre;
  const Vec3 b = cut.ring[1].cast<double>() - cut.centre;
  if (a.cross(b).dot(cut.inwards) < 0) {
    for (auto& triangle : collar.triangles) std::swap(triangle[0], triangle[1]);
  }
  return collar;
}

TriangleMesh ToFloat(const UnionMesh& mesh) {
  TriangleMesh rounded{{}, mesh.triangles};
  for (const Vec3& v : mesh.vertices) rounded.vertices.push_back(v.cast<float>());
  return rounded;
}

// How far collars overlap the core, at least.
double OverlapOf(const std::vector<Cut>& cuts) {
  double overlap = std::numeric_limits<double>::infinity();
  for (const Cut& cut : cuts) {
    overlap = std::min(overlap, (kCollarEnd - kCoreStart) * cut.inwards.norm());
  }
  return overlap;
}

}  // namespace

std::optional<UnionMesh> ReplaceCore(const Junction& junction, const CoreMaker& make_core) {
  std::vector<Cut> cuts;
  std::vector<TriangleMesh> shortened;
  for (const TriangleMesh& stub : junction.stubs) {
    shortened.push_back(Shortened(stub, junction, cuts));
  }
  if (cuts.size() != junction.cut_rings.size()) return std::nullopt;
  std::vector<TriangleMesh> collars;
  for (const Cut& cut : cuts) collars.push_back(Collar(cut));
  // The collars first: they are small, and the core is large.
  const std::optional<UnionMesh> ends = UniteSolids(collars);
  if (!ends) return std::nullopt;
  return UniteSolids({make_core(shortened, OverlapOf(cuts)), ToFloat(*ends)});
}

}  // namespace curvefusion
