#include "meshing/solid_crossing.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "kernel/box_pairs.h"

namespace curvefusion {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// The sides of a plane, or of a line seen along another, on which points lie.
enum Side { kBelow = -1, kOn = 0, kAbove = 1 };

// An edge of a face, in the direction of the face, that crosses another face.
struct EdgeCrossing {
  std::array<int, 2> edge{};
  bool enters = false;  // the solid of the other face
};

// What two faces have in common: nothing, two crossings of edges, or they are in special position.
struct FacePairCrossing {
  int count = 0;
  std::array<EdgeCrossing, 2> crossings;
  std::array<bool, 2> by_edge_of_first{};
};

class CrossingFinder {
 public:
  CrossingFinder(const UnionMesh& both, int second_face) : both_(both), second_face_(second_face) {
    points_.reserve(both.vertices.size());
    for (const Vec3& v : both.vertices) points_.emplace_back(v.x(), v.y(), v.z());
  }

  std::optional<SolidCrossing> Run() {
    for (const auto& [f, g] : NearPairs()) {
      if (!AddPair(f, g)) return std::nullopt;
    }
    std::stable_sort(crossing_.segments.begin(), crossing_.segments.end(),
                     [](const auto& s, const auto& t) { return s.face < t.face; });
    return std::move(crossing_);
  }

 private:
  // Faces of the first and of the second solid whose boxes overlap.
  std::vector<std::pair<int, int>> NearPairs() const {
    std::vector<Eigen::AlignedBox3d> boxes;
    boxes.reserve(both_.triangles.size());
    std::array<Eigen::AlignedBox3d, 2> solids;
    for (const auto& triangle : both_.triangles) {
      Eigen::AlignedBox3d box;
      for (const int v : triangle) box.extend(both_.vertices[v]);
      solids[IsSecond(static_cast<int>(boxes.size()))].extend(box);
      boxes.push_back(box);
    }
    std::array<std::vector<Eigen::AlignedBox3d>, 2> near;
    std::array<std::vector<int>, 2> faces;
    for (size_t i = 0; i < boxes.size(); ++i) {
      const bool second = IsSecond(static_cast<int>(i));
      if (!boxes[i].intersects(solids[!second])) continue;
      near[second].push_back(boxes[i]);
      faces[second].push_back(static_cast<int>(i));
    }
    std::vector<std::pair<int, int>> pairs = BoxTree(near[0]).OverlappingPairs(near[1]);
    for (auto& [f, g] : pairs) {
      f = faces[0][f];
      g = faces[1][g];
    }
    return pairs;
  }

  bool IsSecond(int face) const { return face >= second_face_; }

  Side SideOf(int a, int b, int c, int d) const {
    return static_cast<Side>(CGAL::orientation(points_[a], points_[b], points_[c], points_[d]));
  }

  // The sides of the plane of face f on which the corners of face g lie.
  std::array<Side, 3> SidesOfPlane(int f, int g) const {
    const auto& [a, b, c] = both_.triangles[f];
    const auto& corners = both_.triangles[g];
    return {SideOf(a, b, c, corners[0]), SideOf(a, b, c, corners[1]), SideOf(a, b, c, corners[2])};
  }

  // Adds those edges of face f that cross face g, given the sides of its plane; false where one of
  // them meets a vertex or an edge.
  bool CrossEdges(int f, int g, const std::array<Side, 3>& sides, bool first,
                  FacePairCrossing& pair) const {
    const auto& [a, b, c] = both_.triangles[g];
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      if (sides[k] == sides[next]) continue;
      const int u = both_.triangles[f][k];
      const int v = both_.triangles[f][next];
      const std::array<Side, 3> around = {SideOf(u, v, a, b), SideOf(u, v, b, c),
                                          SideOf(u, v, c, a)};
      const auto [low, high] = std::minmax({around[0], around[1], around[2]});
      if (low == kBelow && high == kAbove) continue;
      if (low == kOn || high == kOn || pair.count == 2) return false;
      pair.by_edge_of_first[pair.count] = first;
      pair.crossings[pair.count++] = {{u, v}, sides[k] == kAbove};
    }
    return true;
  }

  // Finds what faces f of the first and g of the second solid have in common and adds it; false
  // where they are in special position.
  bool AddPair(int f, int g) {
    const std::array<Side, 3> f_sides = SidesOfPlane(g, f);
    if (f_sides[0] == f_sides[1] && f_sides[1] == f_sides[2] && f_sides[0] != kOn) return true;
    const std::array<Side, 3> g_sides = SidesOfPlane(f, g);
    if (g_sides[0] == g_sides[1] && g_sides[1] == g_sides[2] && g_sides[0] != kOn) return true;
    const auto on = [](const std::array<Side, 3>& sides) {
      return std::find(sides.begin(), sides.end(), kOn) != sides.end();
    };
    FacePairCrossing pair;
    if (on(f_sides) || on(g_sides) || !CrossEdges(f, g, f_sides, true, pair) ||
        !CrossEdges(g, f, g_sides, false, pair)) {
      return false;
    }
    return pair.count == 0 || (pair.count == 2 && AddSegments(f, g, pair));
  }

  bool AddSegments(int f, int g, const FacePairCrossing& pair) {
    std::array<int, 2> nodes{};
    std::array<bool, 2> inside_left{};  // in f, on the way from this node to the other
    for (int k = 0; k < 2; ++k) {
      const EdgeCrossing& crossing = pair.crossings[k];
      nodes[k] = NodeOf(crossing.edge, pair.by_edge_of_first[k] ? g : f);
      // What lies ahead on an edge is on the right of the way from the node into the face. In f and
      // in g, the insides lie on different hands.
      inside_left[k] = crossing.enters != pair.by_edge_of_first[k];
    }
    if (inside_left[0] == inside_left[1]) return false;
    if (!inside_left[0]) std::swap(nodes[0], nodes[1]);
    crossing_.segments.push_back({f, nodes[0], nodes[1]});
    crossing_.segments.push_back({g, nodes[1], nodes[0]});
    return true;
  }

  int NodeOf(const std::array<int, 2>& edge, int face) {
    const auto [low, high] = std::minmax(edge[0], edge[1]);
    const auto [entry, is_new] = node_of_.try_emplace(std::make_tuple(low, high, face),
                                                      static_cast<int>(crossing_.nodes.size()));
    if (is_new) {
      const Vec3& from = both_.vertices[low];
      const Vec3 span = both_.vertices[high] - from;
      const auto& [a, b, c] = both_.triangles[face];
      const Vec3& origin = both_.vertices[a];
      const Vec3 normal = (both_.vertices[b] - origin).cross(both_.vertices[c] - origin);
      const double along = std::clamp(normal.dot(origin - from) / normal.dot(span), 0.0, 1.0);
      crossing_.nodes.push_back({low, high, along, from + along * span});
    }
    return entry->second;
  }

  const UnionMesh& both_;
  int second_face_;
  std::vector<Kernel::Point_3> points_;
  std::map<std::tuple<int, int, int>, int> node_of_;  // of an edge and a face
  SolidCrossing crossing_;
};

}  // namespace

std::optional<SolidCrossing> FindCrossing(const UnionMesh& both, int second_face) {
  return CrossingFinder(both, second_face).Run();
}

}  // namespace curvefusion
