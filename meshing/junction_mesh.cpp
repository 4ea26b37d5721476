#include "meshing/junction_mesh.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "kernel/geometry.h"
#include "meshing/junction_union.h"
#include "meshing/self_intersections.h"
#include "meshing/union_cleaning.h"
#include "meshing/watertight.h"

namespace curvefusion {

namespace {

// In radii; each further attempt adds as much again.
constexpr double kPerturbation = 2e-3;
constexpr double kMinEdge = 0.02;
constexpr double kMinHeight = 0.002;

using Place = std::tuple<float, float, float>;
Place PlaceOf(const Vec3f& p) { return {p.x(), p.y(), p.z()}; }

// The cut ring each place belongs to.
std::map<Place, int> RingsByPlace(const Junction& junction) {
  std::map<Place, int> rings;
  for (size_t ring = 0; ring < junction.cut_rings.size(); ++ring) {
    for (const Vec3f& p : junction.cut_rings[ring]) rings[PlaceOf(p)] = static_cast<int>(ring);
  }
  return rings;
}

std::vector<TriangleMesh> PerturbedStubs(const Junction& junction,
                                         const std::map<Place, int>& rings, int attempt,
                                         uint64_t seed) {
  std::vector<TriangleMesh> stubs = junction.stubs;
  if (attempt == 0) return stubs;
  const double amplitude = kPerturbation * attempt * junction.radius;
  seed = (seed * 64 + static_cast<uint64_t>(attempt)) << 24;
  for (TriangleMesh& stub : stubs) {
    for (Vec3f& v : stub.vertices) {
      if (rings.count(PlaceOf(v)) > 0) continue;
      Vec3 offset;
      for (double& x : offset) x = amplitude * (2 * HashedNumber(seed++) - 1);
      v = (v.cast<double>() + offset).cast<float>();
    }
  }
  return stubs;
}

// Removes the discs over the cut rings; nothing where one of them did not come through whole.
std::optional<TriangleMesh> OpenAtCutRings(TriangleMesh mesh, const Junction& junction,
                                           const std::map<Place, int>& rings) {
  std::vector<int> ring_of_vertex;
  for (const Vec3f& v : mesh.vertices) {
    const auto found = rings.find(PlaceOf(v));
    ring_of_vertex.push_back(found == rings.end() ? -1 : found->second);
  }
  std::vector<size_t> removed(junction.cut_rings.size(), 0);
  std::vector<std::array<int, 3>> open;
  for (const auto& triangle : mesh.triangles) {
    const int ring = ring_of_vertex[triangle[0]];
    const bool in_disc = ring >= 0 && ring == ring_of_vertex[triangle[1]] &&
                         ring == ring_of_vertex[triangle[2]];
    if (in_disc) {
      ++removed[ring];
    } else {
      open.push_back(triangle);
    }
  }
  for (size_t ring = 0; ring < removed.size(); ++ring) {
    if (removed[ring] + 2 != junction.cut_rings[ring].size()) return std::nullopt;
  }
  mesh.triangles = std::move(open);
  return mesh;
}

// Whether the mesh is sound, also as a file in millimetres rounds its coordinates.
bool IsSound(const TriangleMesh& mesh) {
  if (!ExamineMesh(mesh).IsWatertight()) return false;
  TriangleMesh millimetres = mesh;
  for (Vec3f& v : millimetres.vertices) v = (v.cast<double>() / kMillimetre).cast<float>();
  return FindSelfIntersections(millimetres, 1).empty();
}

std::optional<TriangleMesh> Attempt(const Junction& junction, const std::map<Place, int>& rings,
                                    int attempt, uint64_t seed) {
  const std::optional<UnionMesh> united =
      UniteSolids(PerturbedStubs(junction, rings, attempt, seed));
  if (!united) return std::nullopt;
  std::vector<Vec3f> kept;
  for (const auto& ring : junction.cut_rings) kept.insert(kept.end(), ring.begin(), ring.end());
  const double coarseness = (1 + attempt) * junction.radius;
  std::optional<TriangleMesh> clean =
      CleanUnion(*united, kept, {kMinEdge * coarseness, kMinHeight * coarseness});
  if (!clean || !IsSound(*clean)) return std::nullopt;
  return OpenAtCutRings(std::move(*clean), junction, rings);
}

}  // namespace

JunctionMesh MeshJunction(const Junction& junction, int max_attempts, uint64_t seed) {
  const std::map<Place, int> rings = RingsByPlace(junction);
  JunctionMesh result;
  while (!result.surface && result.attempts < max_attempts) {
    result.surface = Attempt(junction, rings, result.attempts++, seed);
  }
  return result;
}

// SplitMix64.
double HashedNumber(uint64_t seed) {
  seed += 0x9e3779b97f4a7c15ULL;
  seed = (seed ^ (seed >> 30)) * 0xbf58476d1ce4e5b9ULL;
  seed = (seed ^ (seed >> 27)) * 0x94d049bb133111ebULL;
  return static_cast<double>((seed ^ (seed >> 31)) >> 11) * 0x1.0p-53;
}

}  // namespace curvefusion
