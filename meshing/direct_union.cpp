#include "meshing/direct_union.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "kernel/disjoint_sets.h"
#include "kernel/solid_angle.h"
#include "meshing/face_division.h"
#include "meshing/half_edges.h"
#include "meshing/solid_crossing.h"

namespace curvefusion {

namespace {

using Triangles = std::vector<std::array<int, 3>>;

// Two solids in one list, the triangles of the first before `second_face`.
struct SolidPair {
  UnionMesh both;
  int second_face = 0;
};

SolidPair Joined(const UnionMesh& a, const UnionMesh& b) {
  SolidPair pair{a, static_cast<int>(a.triangles.size())};
  const int offset = static_cast<int>(a.vertices.size());
  pair.both.vertices.insert(pair.both.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.triangles) {
    pair.both.triangles.push_back({i + offset, j + offset, k + offset});
  }
  return pair;
}

// The triangles of both solids after those that cross were divided. Nodes of the crossing are
// vertices behind the given ones.
struct DividedSolids {
  std::vector<Vec3> vertices;
  int first_node = 0;
  std::array<Triangles, 2> triangles;
  // Half-edges between nodes with the inside of the other solid on their left, sorted.
  std::array<std::vector<std::pair<int, int>>, 2> borders;

  bool IsBorder(bool second, int from, int to) const {
    return from >= first_node && to >= first_node &&
           std::binary_search(borders[second].begin(), borders[second].end(),
                              std::make_pair(from, to));
  }
};

class Divider {
 public:
  Divider(const SolidPair& pair, const SolidCrossing& crossing)
      : pair_(pair), crossing_(crossing), first_node_(static_cast<int>(pair.both.vertices.size())) {
    divided_.vertices = pair.both.vertices;
    for (size_t i = 0; i < crossing.nodes.size(); ++i) {
      const CrossingNode& node = crossing.nodes[i];
      divided_.vertices.push_back(node.point);
      nodes_on_edge_[{node.low, node.high}].push_back(static_cast<int>(i));
    }
    for (auto& [edge, nodes] : nodes_on_edge_) {
      std::sort(nodes.begin(), nodes.end(), [&crossing](int i, int j) {
        return crossing.nodes[i].along < crossing.nodes[j].along;
      });
    }
  }

  std::optional<DividedSolids> Run() {
    auto segment = crossing_.segments.begin();
    for (int face = 0; face < static_cast<int>(pair_.both.triangles.size()); ++face) {
      const auto first = segment;
      while (segment != crossing_.segments.end() && segment->face == face) ++segment;
      Triangles& triangles = divided_.triangles[IsSecond(face)];
      if (first == segment) {
        triangles.push_back(pair_.both.triangles[face]);
        continue;
      }
      const auto parts = DivideFace(ToDivide(face, {first, segment}), divided_.vertices);
      if (!parts) return std::nullopt;
      triangles.insert(triangles.end(), parts->begin(), parts->end());
    }
    for (auto& borders : divided_.borders) std::sort(borders.begin(), borders.end());
    return std::move(divided_);
  }

 private:
  bool IsSecond(int face) const { return face >= pair_.second_face; }

  FaceToDivide ToDivide(int face, const std::vector<CrossingSegment>& segments) {
    FaceToDivide division;
    division.corners = pair_.both.triangles[face];
    for (int k = 0; k < 3; ++k) {
      const int u = division.corners[k];
      const int v = division.corners[(k + 1) % 3];
      division.boundary.push_back(u);
      const auto found = nodes_on_edge_.find(std::minmax(u, v));
      if (found == nodes_on_edge_.end()) continue;
      const size_t count = division.boundary.size();
      for (const int node : found->second) division.boundary.push_back(first_node_ + node);
      if (u > v) {
        std::reverse(division.boundary.begin() + static_cast<std::ptrdiff_t>(count),
                     division.boundary.end());
      }
    }
    for (const CrossingSegment& s : segments) {
      division.segments.emplace_back(first_node_ + s.from, first_node_ + s.to);
      divided_.borders[IsSecond(face)].push_back(division.segments.back());
    }
    return division;
  }

  const SolidPair& pair_;
  const SolidCrossing& crossing_;
  int first_node_;
  std::map<std::pair<int, int>, std::vector<int>> nodes_on_edge_;  // sorted along it
  DividedSolids divided_;
};

// Whether a point is inside a solid: its winding number.
bool IsInside(const Vec3& p, const SolidPair& pair, bool second) {
  const size_t first = second ? static_cast<size_t>(pair.second_face) : 0;
  const size_t last = second ? pair.both.triangles.size() : static_cast<size_t>(pair.second_face);
  double angle = 0;
  for (size_t f = first; f < last; ++f) {
    const auto& [a, b, c] = pair.both.triangles[f];
    angle +=
        SolidAngle(pair.both.vertices[a] - p, pair.both.vertices[b] - p, pair.both.vertices[c] - p);
  }
  return angle > 2 * std::numbers::pi;
}

bool ArePaired(const HalfEdge& h, const HalfEdge& other) {
  return h.low == other.low && h.high == other.high && h.forward != other.forward;
}

enum class Place { kUnknown, kInside, kOutside };

// The place of every triangle of a solid, found at the crossing and carried over edges that are not
// part of it; unknown for patches that the crossing does not touch. Nothing where it contradicts
// itself.
std::optional<std::vector<Place>> PlacesOf(const DividedSolids& divided, bool second,
                                           DisjointSets& patches) {
  const std::vector<HalfEdge> half_edges = SortedHalfEdges(divided.triangles[second]);
  std::vector<std::pair<int, Place>> known;  // of faces
  for (size_t i = 0; i + 1 < half_edges.size(); i += 2) {
    const HalfEdge& h = half_edges[i];
    const HalfEdge& other = half_edges[i + 1];
    if (!ArePaired(h, other)) return std::nullopt;
    const int forward = h.forward ? h.face : other.face;
    const int backward = h.forward ? other.face : h.face;
    if (divided.IsBorder(second, h.low, h.high)) {
      known.insert(known.end(), {{forward, Place::kInside}, {backward, Place::kOutside}});
    } else if (divided.IsBorder(second, h.high, h.low)) {
      known.insert(known.end(), {{forward, Place::kOutside}, {backward, Place::kInside}});
    } else {
      patches.Unite(h.face, other.face);
    }
  }
  std::vector<Place> places(divided.triangles[second].size(), Place::kUnknown);
  for (const auto& [face, place] : known) {
    Place& of_patch = places[patches.Root(face)];
    if (of_patch != Place::kUnknown && of_patch != place) return std::nullopt;
    of_patch = place;
  }
  return places;
}

// Adds the parts of a solid that are outside of the other; false where that contradicts itself.
bool KeepOutside(const DividedSolids& divided, const SolidPair& pair, bool second,
                 Triangles& kept) {
  const Triangles& triangles = divided.triangles[second];
  DisjointSets patches(triangles.size());
  std::optional<std::vector<Place>> places = PlacesOf(divided, second, patches);
  if (!places) return false;
  for (size_t i = 0; i < triangles.size(); ++i) {
    Place& of_patch = (*places)[patches.Root(static_cast<int>(i))];
    if (of_patch == Place::kUnknown) {
      const Vec3& corner = divided.vertices[triangles[i][0]];
      of_patch = IsInside(corner, pair, !second) ? Place::kInside : Place::kOutside;
    }
    if (of_patch == Place::kOutside) kept.push_back(triangles[i]);
  }
  return true;
}

bool IsClosed(const Triangles& triangles) {
  const std::vector<HalfEdge> half_edges = SortedHalfEdges(triangles);
  for (size_t i = 0; i < half_edges.size(); i += 2) {
    const HalfEdge& h = half_edges[i];
    const HalfEdge& other = half_edges[i + 1];
    if (!ArePaired(h, other)) return false;
  }
  return true;
}

UnionMesh WithUsedVertices(const std::vector<Vec3>& vertices, Triangles triangles) {
  UnionMesh mesh;
  std::vector<int> index(vertices.size(), -1);
  for (auto& triangle : triangles) {
    for (int& v : triangle) {
      if (index[v] < 0) {
        index[v] = static_cast<int>(mesh.vertices.size());
        mesh.vertices.push_back(vertices[v]);
      }
      v = index[v];
    }
  }
  mesh.triangles = std::move(triangles);
  return mesh;
}

}  // namespace

std::optional<UnionMesh> UniteDirectly(const UnionMesh& a, const UnionMesh& b) {
  const SolidPair pair = Joined(a, b);
  const auto crossing = FindCrossing(pair.both, pair.second_face);
  if (!crossing) return std::nullopt;
  const auto divided = Divider(pair, *crossing).Run();
  if (!divided) return std::nullopt;
  Triangles kept;
  if (!KeepOutside(*divided, pair, false, kept) || !KeepOutside(*divided, pair, true, kept)) {
    return std::nullopt;
  }
  if (!IsClosed(kept)) return std::nullopt;
  return WithUsedVertices(divided->vertices, std::move(kept));
}

}  // namespace curvefusion
