#include "meshing/tubes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <utility>

#include "kernel/error.h"
#include "kernel/parallel.h"
#include "meshing/contacts.h"
#include "meshing/junction_mesh.h"
#include "meshing/sweep.h"
#include "meshing/tube_network.h"
#include "meshing/tube_paths.h"

namespace curvefusion {

namespace {

constexpr double kMaxTurn = std::numbers::pi / 4;  // at a mitred ring

// Tubes ready to be swept, and the groups of them that touch.
struct TubeLayout {
  std::vector<TubePath> paths;
  std::vector<TubeRings> rings;
  std::vector<std::vector<TubeStretch>> groups;
};

TubeLayout LayOutTubes(const SkeletonGraph& graph, const TubeOptions& options) {
  TubeLayout layout;
  const TubeNetwork network =
      PrepareTubes(graph, options.default_radius, options.axis_tolerance, kMaxTurn);
  layout.paths = CutSelfContacts(ChainTubes(network, kMaxTurn, options.ring_spacing));
  layout.rings.resize(layout.paths.size());
  ParallelFor(0, static_cast<int64_t>(layout.paths.size()), 16, [&](int64_t i) {
    // Rings of different tubes are turned against each other, so that their facets do not lie in
    // one plane where the tubes meet.
    const double phase = 2 * std::numbers::pi / options.sides * HashedNumber(static_cast<uint64_t>(i));
    layout.rings[i] = SweepRings(layout.paths[i], options.sides, phase);
  });
  layout.groups = GroupContacts(layout.paths);
  return layout;
}

std::vector<Vec3f> RingVertices(const TubeRings& rings, int point) {
  const int ring = rings.ring_of_point[point % rings.ring_of_point.size()];
  const auto first = rings.vertices.begin() + static_cast<std::ptrdiff_t>(ring) * rings.sides;
  return {first, first + rings.sides};
}

Junction JunctionOf(const TubeLayout& layout, const std::vector<TubeStretch>& group) {
  Junction junction;
  junction.radius = std::numeric_limits<double>::infinity();
  for (const TubeStretch& stretch : group) {
    const TubePath& path = layout.paths[stretch.path];
    const TubeRings& rings = layout.rings[stretch.path];
    junction.stubs.push_back(CloseStub(rings, stretch.first, stretch.last));
    junction.radius = std::min(
        junction.radius, *std::min_element(path.axis.radii.begin(), path.axis.radii.end()));
    const bool whole_ring = path.closed && stretch.last - stretch.first == path.segment_count();
    if (whole_ring) continue;
    if (path.closed || stretch.first > 0) {
      junction.cut_rings.push_back(RingVertices(rings, stretch.first));
    }
    if (path.closed || stretch.last < path.segment_count()) {
      junction.cut_rings.push_back(RingVertices(rings, stretch.last));
    }
  }
  return junction;
}

void AppendMesh(const TriangleMesh& part, TriangleMesh& whole) {
  const int offset = static_cast<int>(whole.vertices.size());
  whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& [a, b, c] : part.triangles) {
    whole.triangles.push_back({a + offset, b + offset, c + offset});
  }
}

TriangleMesh SweptStretch(const TubeLayout& layout, const TubeStretch& stretch) {
  const TubeRings& rings = layout.rings[stretch.path];
  TriangleMesh mesh{rings.vertices, {}};
  for (int segment = stretch.first; segment < stretch.last; ++segment) {
    const auto side = SegmentTriangles(rings, segment % layout.paths[stretch.path].segment_count());
    mesh.triangles.insert(mesh.triangles.end(), side.begin(), side.end());
  }
  return mesh;
}

Vec3 MiddleOf(const Junction& junction) {
  Eigen::AlignedBox3f box;
  for (const TriangleMesh& stub : junction.stubs) {
    for (const Vec3f& v : stub.vertices) box.extend(v);
  }
  return box.center().cast<double>();
}

[[noreturn]] void ThrowUnsound(const Vec3& place, const std::string& what) {
  throw Error(ErrorKind::kBadInput,
              fmt::format("tubes near ({:.4f}, {:.4f}, {:.4f}) m: {}; remove doubled or very short "
                          "edges there, or make the tubes a little thinner or thicker",
                          place.x(), place.y(), place.z(), what));
}

}  // namespace

void VisitOptions(TubeOptions& options, OptionVisitor& visitor) {
  visitor.BeginSection("tubes");
  visitor.Visit({"default_radius", "m", 1e-5, 1.0, "Radius of edges without radii."},
                options.default_radius);
  visitor.Visit({"sides", "", 8, 64, "Corners of a tube's cross-section."}, options.sides);
  visitor.Visit({"ring_spacing", "radii", 1.0, 20.0, "Spacing of rings along straight tubes."},
                options.ring_spacing);
  visitor.Visit({"axis_tolerance", "radii", 0.005, 0.2,
                 "How far the simplified axis of a tube may lie from the skeleton."},
                options.axis_tolerance);
  visitor.Visit({"attempts", "", 1, 20, "Attempts at a junction, each slightly perturbed."},
                options.attempts);
}

TubeMesh BuildTubes(const SkeletonGraph& graph, const TubeOptions& options) {
  TubeMesh tubes;
  if (graph.empty()) return tubes;
  const TubeLayout layout = LayOutTubes(graph, options);
  tubes.paths = static_cast<int>(layout.paths.size());
  std::vector<Junction> junctions(layout.groups.size());
  std::vector<JunctionMesh> meshes(layout.groups.size());
  ParallelFor(0, static_cast<int64_t>(layout.groups.size()), 1, [&](int64_t i) {
    if (layout.groups[i].size() == 1) return;
    junctions[i] = JunctionOf(layout, layout.groups[i]);
    meshes[i] = MeshJunction(junctions[i], options.attempts, static_cast<uint64_t>(i));
  });
  TriangleMesh whole;
  for (size_t i = 0; i < layout.groups.size(); ++i) {
    if (layout.groups[i].size() == 1) {
      AppendMesh(SweptStretch(layout, layout.groups[i][0]), whole);
      continue;
    }
    ++tubes.unions;
    const Vec3 place = MiddleOf(junctions[i]);
    if (!meshes[i].surface) ThrowUnsound(place, "their union did not come out");
    if (meshes[i].attempts > 1) {
      tubes.fallbacks.push_back({place, static_cast<int>(junctions[i].stubs.size()),
                                 meshes[i].attempts, "perturbed by a few thousandths of the radius"});
    }
    AppendMesh(*meshes[i].surface, whole);
  }
  whole = WeldVertices(whole);
  tubes.report = ExamineMesh(whole);
  if (!tubes.report.IsWatertight()) {
    ThrowUnsound(whole.vertices.front().cast<double>(), tubes.report.Defects());
  }
  tubes.surface = *ToSurfaceMesh(whole);
  return tubes;
}

}  // namespace curvefusion
