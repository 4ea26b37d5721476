#include "meshing/watertight.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <numeric>
#include <tuple>
#include <vector>

#include "kernel/angle.h"
#include "kernel/disjoint_sets.h"
#include "kernel/error.h"
#include "kernel/solid_angle.h"
#include "meshing/half_edges.h"
#include "meshing/self_intersections.h"

namespace curvefusion {

namespace {

// Corner 3 f + k stands for vertex k of triangle f; corners of one vertex that lie in one fan end
// up in one set.
class Fans {
 public:
  explicit Fans(const TriangleMesh& mesh) : mesh_(mesh), corners_(3 * mesh.triangles.size()) {}

  void JoinAcrossEdge(const HalfEdge& a, const HalfEdge& b) {
    corners_.Unite(CornerOf(mesh_, a.face, a.low), CornerOf(mesh_, b.face, a.low));
    corners_.Unite(CornerOf(mesh_, a.face, a.high), CornerOf(mesh_, b.face, a.high));
  }

  // Their number; `first` becomes one of them.
  int64_t VerticesWithSeveralFans(int& first) {
    std::vector<int> fans(mesh_.vertices.size(), 0);
    for (size_t f = 0; f < mesh_.triangles.size(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const int corner = static_cast<int>(3 * f) + k;
        fans[mesh_.triangles[f][k]] += corners_.Root(corner) == corner;
      }
    }
    const auto several = [](int n) { return n > 1; };
    first = static_cast<int>(std::find_if(fans.begin(), fans.end(), several) - fans.begin());
    return std::count_if(fans.begin(), fans.end(), several);
  }

 private:
  const TriangleMesh& mesh_;
  DisjointSets corners_;
};

void NotePlace(const TriangleMesh& mesh, int vertex, WatertightReport& report) {
  if (!report.defect_place) report.defect_place = mesh.vertices[vertex].cast<double>();
}

// Counts edges by how many triangles they have; returns the number of edges and, in `component`,
// the component of every face.
int64_t ExamineEdges(const TriangleMesh& mesh, WatertightReport& report,
                     std::vector<int>& component) {
  const std::vector<HalfEdge> half_edges = SortedHalfEdges(mesh.triangles);
  Fans fans(mesh);
  DisjointSets faces(mesh.triangles.size());
  int64_t edges = 0;
  for (size_t i = 0, end = 0; i < half_edges.size(); i = end, ++edges) {
    while (end < half_edges.size() && half_edges[end].low == half_edges[i].low &&
           half_edges[end].high == half_edges[i].high) {
      faces.Unite(half_edges[i].face, half_edges[end].face);
      ++end;
    }
    const bool paired = end - i == 2;
    const bool misoriented = paired && half_edges[i].forward == half_edges[i + 1].forward;
    if (!paired || misoriented) NotePlace(mesh, half_edges[i].low, report);
    report.boundary_edges += end - i == 1;
    report.non_manifold_edges += end - i > 2;
    report.misoriented_edges += misoriented;
    if (paired) fans.JoinAcrossEdge(half_edges[i], half_edges[i + 1]);
  }
  int vertex = 0;
  const int64_t several_fans = fans.VerticesWithSeveralFans(vertex);
  if (several_fans > 0) NotePlace(mesh, vertex, report);
  report.non_manifold_vertices = several_fans;
  component.resize(mesh.triangles.size());
  std::vector<int> number(mesh.triangles.size(), -1);
  for (size_t f = 0; f < component.size(); ++f) {
    int& of_root = number[faces.Root(static_cast<int>(f))];
    if (of_root < 0) of_root = report.components++;
    component[f] = of_root;
  }
  return edges;
}

double SmallestAngle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::min(
      {AngleBetween(b - a, c - a), AngleBetween(a - b, c - b), AngleBetween(a - c, b - c)});
}

// A component of the surface and what it encloses.
struct Shell {
  double volume = 0;
  Eigen::AlignedBox3d box;
  Vec3 point = Vec3::Zero();  // on the shell
};

std::vector<Shell> ShellsOf(const TriangleMesh& mesh, const std::vector<int>& component,
                            WatertightReport& report) {
  std::vector<Shell> shells(report.components);
  report.min_angle = mesh.triangles.empty() ? 0 : std::numbers::pi;
  const Vec3 origin = mesh.vertices.empty() ? Vec3::Zero() : Vec3(mesh.vertices[0].cast<double>());
  for (size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto [a, b, c] = CornersOf(mesh, f);
    Shell& shell = shells[component[f]];
    shell.volume += (a - origin).dot((b - origin).cross(c - origin)) / 6;
    shell.box.extend(a).extend(b).extend(c);
    shell.point = a;
    report.area += (b - a).cross(c - a).norm() / 2;
    report.min_angle = std::min(report.min_angle, SmallestAngle(a, b, c));
  }
  for (const Shell& shell : shells) report.volume += shell.volume;
  return shells;
}

// Shells around a point of another shell: the sum of their winding numbers must be 0 for a solid,
// 1 for a cavity.
int MisplacedShells(const TriangleMesh& mesh, const std::vector<int>& component,
                    const std::vector<Shell>& shells) {
  std::vector<double> winding(shells.size(), 0.0);
  for (size_t inner = 0; inner < shells.size(); ++inner) {
    std::vector<char> around(shells.size(), 0);
    for (size_t outer = 0; outer < shells.size(); ++outer) {
      around[outer] = outer != inner && shells[outer].box.contains(shells[inner].point);
    }
    if (std::find(around.begin(), around.end(), 1) == around.end()) continue;
    const Vec3& p = shells[inner].point;
    for (size_t f = 0; f < mesh.triangles.size(); ++f) {
      if (!around[component[f]]) continue;
      const auto [a, b, c] = CornersOf(mesh, f);
      winding[inner] += SolidAngle(a - p, b - p, c - p);
    }
  }
  int misplaced = 0;
  for (size_t i = 0; i < shells.size(); ++i) {
    const bool inside = winding[i] > 2 * std::numbers::pi;
    misplaced += inside == (shells[i].volume > 0);
  }
  return misplaced;
}

void RequireUsable(const TriangleMesh& mesh) {
  const int n = static_cast<int>(mesh.vertices.size());
  for (size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (const int v : mesh.triangles[f]) {
      if (v < 0 || v >= n) {
        throw Error(ErrorKind::kBadInput,
                    fmt::format("mesh: triangle {} uses vertex {} of {}", f, v, n));
      }
    }
  }
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!mesh.vertices[v].allFinite()) {
      throw Error(ErrorKind::kBadInput, fmt::format("mesh: vertex {} is not finite", v));
    }
  }
}

}  // namespace

TriangleMesh WeldVertices(const TriangleMesh& mesh) {
  struct Place {
    float x, y, z;
    int vertex;
    bool operator<(const Place& o) const {
      return std::tie(x, y, z, vertex) < std::tie(o.x, o.y, o.z, o.vertex);
    }
    bool SameAs(const Place& o) const { return x == o.x && y == o.y && z == o.z; }
  };
  std::vector<Place> places;
  places.reserve(mesh.vertices.size());
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3f& p = mesh.vertices[v];
    places.push_back({p.x(), p.y(), p.z(), static_cast<int>(v)});
  }
  std::sort(places.begin(), places.end());
  std::vector<int> first(mesh.vertices.size());
  for (size_t i = 0; i < places.size(); ++i) {
    const bool repeated = i > 0 && places[i].SameAs(places[i - 1]);
    first[places[i].vertex] = repeated ? first[places[i - 1].vertex] : places[i].vertex;
  }
  TriangleMesh welded;
  std::vector<int> index(mesh.vertices.size(), -1);
  welded.triangles = mesh.triangles;
  for (auto& triangle : welded.triangles) {
    for (int& v : triangle) {
      int& new_index = index[first[v]];
      if (new_index < 0) {
        new_index = static_cast<int>(welded.vertices.size());
        welded.vertices.push_back(mesh.vertices[first[v]]);
      }
      v = new_index;
    }
  }
  return welded;
}

WatertightReport ExamineMesh(const TriangleMesh& original) {
  RequireUsable(original);
  const TriangleMesh mesh = WeldVertices(original);
  WatertightReport report;
  report.vertices = static_cast<int64_t>(mesh.vertices.size());
  report.faces = static_cast<int64_t>(mesh.triangles.size());
  std::vector<int> component;
  const int64_t edges = ExamineEdges(mesh, report, component);
  const std::vector<Shell> shells = ShellsOf(mesh, component, report);
  for (const auto& [i, j] : FindSelfIntersections(mesh)) {
    NotePlace(mesh, mesh.triangles[i][0], report);
    ++(i == j ? report.degenerate_faces : report.self_intersections);
  }
  if (report.boundary_edges + report.non_manifold_edges + report.non_manifold_vertices +
          report.misoriented_edges ==
      0) {
    report.genus = report.components - (report.vertices - edges + report.faces) / 2;
    report.misplaced_components = MisplacedShells(mesh, component, shells);
  }
  return report;
}

bool WatertightReport::IsWatertight() const { return faces > 0 && Defects().empty(); }

std::string WatertightReport::Defects() const {
  std::string defects;
  const auto add = [&defects](int64_t count, const char* what) {
    if (count > 0) defects += fmt::format("{}{} {}", defects.empty() ? "" : ", ", count, what);
  };
  add(boundary_edges, "boundary edges");
  add(non_manifold_edges, "edges of more than two triangles");
  add(non_manifold_vertices, "vertices of more than one fan");
  add(misoriented_edges, "edges with inconsistent orientation");
  add(degenerate_faces, "triangles without area");
  add(self_intersections, "self-intersections");
  add(misplaced_components, "components inside out");
  return defects;
}

}  // namespace curvefusion
