#include "meshing/junction_mesh.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "kernel/disjoint_sets.h"
#include "kernel/geometry.h"
#include "meshing/hashed_number.h"
#include "meshing/junction_core.h"
#include "meshing/junction_union.h"
#include "meshing/junction_wrap.h"
#include "meshing/self_intersections.h"
#include "meshing/sweep.h"
#include "meshing/union_cleaning.h"
#include "meshing/union_resampling.h"

namespace curvefusion {

namespace {

// In radii.
constexpr double kPerturbation = 2e-3;  // each further attempt adds as much again
constexpr double kMinEdge = 0.06;
constexpr double kMinHeight = 0.02;
constexpr double kZoneRadius = 0.2;
constexpr double kTinyHollow = 0.05;  // across; radii larger by a fortieth close it
// Likewise where tubes were resampled: on a grid gaps between them come apart in hollows.
constexpr double kResampledHollow = 2.0;
// A tube has a dozen corners on such a grid, and loses 2 % of its section.
constexpr double kGridSpacing = 0.5;
// The rim of a flat end loses a cell, which should not reach the end of the collar. Mostly the two
// fit all the same; where they do not, the grid is finer, but no finer than the last of these:
// segments shorter than some radii, as of curves with noise, are left to chance.
constexpr std::array kLeastGridSpacings = {kGridSpacing, 0.15};

// A crowded junction has so many creases that some place fails in nearly every attempt, and an
// attempt takes long: a planar fan of 50 tubes fails in 24 of 24. Up to kUncrowded tubes it has all
// its attempts, beyond it fewer, so that their product stays the same, and then the last resort.
constexpr int kUncrowded = 16;
constexpr int kCleaningRounds = 7;
// From so many tubes on, where they are not short, it has one attempt only, without exact
// constructions, and few rounds: what comes out at all does so then (200 tubes of random
// directions), and the rest would take a minute.
constexpr int kVeryCrowded = 40;
constexpr int kFewRounds = 2;
// Radii: so many tubes that overlap for so long in the mean never come out (73 to 146 where 100 to
// 200 meet in a plane or on a cone; below 40 where they are spread over the sphere).
constexpr double kLongOverlap = 60;
// Squared radii of all tubes: larger junctions are resampled, smaller ones wrapped. Chosen:
// wrapping so much takes about 3 s, fans of 39 to 200 tubes, several times as large, 10 to 110 s.
constexpr double kMostWrapped = 4000;
constexpr std::array<double, 5> kZoneFactors = {0.3, 0.03, 0.7, 0.1, 0.01};

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

Vec3 RandomOffset(double amplitude, uint64_t& seed) {
  Vec3 offset;
  for (double& x : offset) x = amplitude * (2 * HashedNumber(seed++) - 1);
  return offset;
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
      v = (v.cast<double>() + RandomOffset(amplitude, seed)).cast<float>();
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
    const bool in_disc =
        ring >= 0 && ring == ring_of_vertex[triangle[1]] && ring == ring_of_vertex[triangle[2]];
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

// Cleaning makes sheets collide that pass each other closely: there it is done more finely.
class ZoneList {
 public:
  explicit ZoneList(double radius) : radius_(radius) {}

  void Mark(const TriangleMesh& mesh, const std::vector<std::pair<int, int>>& collisions) {
    std::vector<char> marked(zones_.size(), 0);
    for (const auto& [i, j] : collisions) {
      for (const int face : {i, j}) {
        for (const int v : mesh.triangles[face]) MarkPlace(mesh.vertices[v].cast<double>(), marked);
      }
    }
  }

  std::vector<CleaningZone> Zones() const {
    std::vector<CleaningZone> zones;
    for (const Zone& zone : zones_) {
      zones.push_back({zone.centre, radius_, kZoneFactors[zone.level % kZoneFactors.size()]});
    }
    return zones;
  }

 private:
  struct Zone {
    Vec3 centre;
    size_t level;
  };

  // Raises the level of the zone at a place, once in a round, or makes a new one.
  void MarkPlace(const Vec3& place, std::vector<char>& marked) {
    for (size_t i = 0; i < zones_.size(); ++i) {
      if ((zones_[i].centre - place).norm() > radius_) continue;
      if (!marked[i]) ++zones_[i].level;
      marked[i] = 1;
      return;
    }
    zones_.push_back({place, 0});
    marked.push_back(1);
  }

  double radius_;
  std::vector<Zone> zones_;
};

// Of all stubs, in squared radii.
double AreaOf(const Junction& junction) {
  double area = 0;
  for (const TriangleMesh& stub : junction.stubs) {
    for (const auto& [a, b, c] : stub.triangles) {
      const Vec3f& p = stub.vertices[a];
      area += 0.5 * (stub.vertices[b] - p).cross(stub.vertices[c] - p).norm();
    }
  }
  return area / (junction.radius * junction.radius);
}

// In radii.
double MeanLength(const Junction& junction) {
  return AreaOf(junction) / (2 * std::numbers::pi * static_cast<double>(junction.stubs.size()));
}

bool IsVeryCrowded(const Junction& junction) {
  return junction.stubs.size() >= kVeryCrowded && AreaOf(junction) >= kMostWrapped;
}

// Cleans a union until nothing collides.
std::optional<TriangleMesh> CleanSoundly(const UnionMesh& united, const Junction& junction) {
  ZoneList zones(kZoneRadius * junction.radius);
  const int rounds = IsVeryCrowded(junction) ? kFewRounds : kCleaningRounds;
  for (int round = 0; round < rounds; ++round) {
    std::optional<TriangleMesh> clean =
        CleanUnion(united, junction.cut_rings,
                   {kMinEdge * junction.radius, kMinHeight * junction.radius, zones.Zones()});
    if (!clean) return std::nullopt;
    const auto collisions = FindSelfIntersectionsInFiles(*clean);
    if (collisions.empty()) return clean;
    zones.Mark(*clean, collisions);
  }
  return std::nullopt;
}

void Roughen(UnionMesh& united, double amplitude, const std::map<Place, int>& rings) {
  uint64_t seed = 0;
  for (Vec3& v : united.vertices) {
    if (rings.count(PlaceOf(v.cast<float>())) == 0) v += RandomOffset(amplitude, seed);
  }
}

// Drops hollows so small that whether they are there is chance: between ends of tubes that nearly
// coincide in a node.
void CloseTinyHollows(UnionMesh& united, double size) {
  DisjointSets shells(united.vertices.size());
  for (const auto& [a, b, c] : united.triangles) {
    shells.Unite(a, b);
    shells.Unite(b, c);
  }
  std::map<int, Eigen::AlignedBox3d> boxes;
  for (const auto& triangle : united.triangles) {
    Eigen::AlignedBox3d& box = boxes[shells.Root(triangle[0])];
    for (const int v : triangle) box.extend(united.vertices[v]);
  }
  if (boxes.size() == 1) return;
  std::erase_if(united.triangles, [&](const std::array<int, 3>& triangle) {
    return boxes.at(shells.Root(triangle[0])).sizes().maxCoeff() < size;
  });
}

// What is left to do for the union of a junction's stubs.
std::optional<TriangleMesh> Finished(std::optional<UnionMesh> united, const Junction& junction,
                                     const std::map<Place, int>& rings, double tiny_hollow) {
  if (!united) return std::nullopt;
  CloseTinyHollows(*united, tiny_hollow * junction.radius);
  Roughen(*united, kSurfaceRoughness * junction.radius, rings);
  std::optional<TriangleMesh> clean = CleanSoundly(*united, junction);
  if (!clean) return std::nullopt;
  return OpenAtCutRings(std::move(*clean), junction, rings);
}

JunctionMeshOptions WithinBudget(const JunctionMeshOptions& options, const Junction& junction) {
  const int count = static_cast<int>(junction.stubs.size());
  if (count <= kUncrowded) return options;
  const int one = std::min(options.max_attempts, 1);
  if (IsVeryCrowded(junction)) return {MeanLength(junction) < kLongOverlap ? one : 0, true};
  return {std::max(one, options.max_attempts * kUncrowded / count), true};
}

// The last resort for a junction whose tubes cannot be united: their union resampled on a grid of
// half the radius (ResampleUnion), or of what the cut rings allow where that is less, but of at
// least `least_spacing` radii, united with the unchanged ends of the stubs at the cut rings. It
// does not depend on how tubes cross; gaps and crotches narrower than the grid may close. Nothing
// where the ends do not fit. Cost: 3 microseconds for each square of the grid that the surface
// covers.
std::optional<UnionMesh> ResampleJunction(const Junction& junction, double least_spacing) {
  return ReplaceCore(junction, [&](const std::vector<TriangleMesh>& stubs, double overlap) {
    const double spacing = std::min(kGridSpacing * junction.radius, overlap);
    return ResampleUnion(stubs, std::max(spacing, least_spacing * junction.radius));
  });
}

void TakeLastResort(const Junction& junction, const std::map<Place, int>& rings,
                    JunctionMesh& result) {
  if (AreaOf(junction) < kMostWrapped) {
    result.surface = Finished(WrapJunction(junction), junction, rings, kTinyHollow);
    result.last_resort = LastResort::kWrapping;
  } else {
    for (const double least_spacing : kLeastGridSpacings) {
      result.surface =
          Finished(ResampleJunction(junction, least_spacing), junction, rings, kResampledHollow);
      if (result.surface) break;
    }
    result.last_resort = LastResort::kResampling;
  }
}

}  // namespace

JunctionMesh MeshJunction(const Junction& junction, const JunctionMeshOptions& options,
                          uint64_t seed) {
  const std::map<Place, int> rings = RingsByPlace(junction);
  const auto [max_attempts, last_resort] = WithinBudget(options, junction);
  JunctionMesh result;
  const auto unite = IsVeryCrowded(junction) ? UniteSolidsDirectly : UniteSolids;
  while (!result.surface && result.attempts < max_attempts) {
    auto united = unite(PerturbedStubs(junction, rings, result.attempts++, seed));
    result.surface = Finished(std::move(united), junction, rings, kTinyHollow);
  }
  if (!result.surface && last_resort) TakeLastResort(junction, rings, result);
  return result;
}

}  // namespace curvefusion
