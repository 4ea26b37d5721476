#include "meshing/tubes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "kernel/error.h"
#include "kernel/parallel.h"
#include "meshing/junction_mesh.h"
#include "meshing/stubs.h"
#include "meshing/tube_layout.h"

namespace curvefusion {

namespace {

// How often all tubes are laid out anew, turned about their axes, where one place does not come
// out.
constexpr int kTurns = 3;

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
    junction.radius = std::min(junction.radius,
                               *std::min_element(path.axis.radii.begin(), path.axis.radii.end()));
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

Vec3 MiddleOf(const Junction& junction) {
  Eigen::AlignedBox3f box;
  for (const TriangleMesh& stub : junction.stubs) {
    for (const Vec3f& v : stub.vertices) box.extend(v);
  }
  return box.center().cast<double>();
}

// All tubes as one surface, or where and why it is not sound.
struct Assembly {
  TriangleMesh mesh;
  WatertightReport report;
  int unions = 0;
  std::vector<TubeFallback> fallbacks;
  std::string failure;
  Vec3 failure_place = Vec3::Zero();
};

void AppendJunction(const Junction& junction, const JunctionMesh& part, Assembly& assembly) {
  const Vec3 place = MiddleOf(junction);
  ++assembly.unions;
  if (!part.surface) {
    assembly.failure = fmt::format("the union of {} tubes did not come out in {} attempts",
                                   junction.stubs.size(), part.attempts);
    assembly.failure_place = place;
    return;
  }
  if (part.last_resort != LastResort::kNone) {
    const char* remedy = part.last_resort == LastResort::kWrapping
                             ? "wrapped: crotches and gaps narrower than two thirds of the radius "
                               "are closed there"
                             : "resampled on a grid of half the radius: finer gaps and crotches "
                               "are not to be relied on there";
    assembly.fallbacks.push_back(
        {place, static_cast<int>(junction.stubs.size()), part.attempts, remedy, true});
  } else if (part.attempts > 1) {
    assembly.fallbacks.push_back({place, static_cast<int>(junction.stubs.size()), part.attempts,
                                  "moved vertices by a few thousandths of the radius"});
  }
  Append(*part.surface, assembly.mesh);
}

Assembly Assemble(const TubeLayout& layout, const JunctionMeshOptions& options) {
  const int64_t count = static_cast<int64_t>(layout.groups.size());
  std::vector<Junction> junctions(layout.groups.size());
  std::vector<JunctionMesh> parts(layout.groups.size());
  ParallelFor(0, count, 1, [&](int64_t i) {
    if (layout.groups[i].size() == 1) return;
    junctions[i] = JunctionOf(layout, layout.groups[i]);
    parts[i] = MeshJunction(junctions[i], options, static_cast<uint64_t>(i));
  });
  Assembly assembly;
  for (int64_t i = 0; i < count; ++i) {
    if (layout.groups[i].size() == 1) {
      const TubeStretch& stretch = layout.groups[i][0];
      Append(SideOfStub(layout.rings[stretch.path], stretch.first, stretch.last), assembly.mesh);
    } else {
      AppendJunction(junctions[i], parts[i], assembly);
    }
  }
  if (!assembly.failure.empty()) return assembly;
  assembly.mesh = WeldVertices(assembly.mesh);
  assembly.report = ExamineMesh(assembly.mesh);
  assembly.failure = assembly.report.Defects();
  assembly.failure_place = assembly.report.defect_place.value_or(Vec3::Zero());
  return assembly;
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
  for (int turn = 0;; ++turn) {
    const TubeLayout layout = LayOutTubes(graph, options, static_cast<uint64_t>(turn));
    Assembly assembly = Assemble(layout, {options.attempts, turn + 1 == kTurns});
    const Vec3& place = assembly.failure_place;
    if (assembly.failure.empty()) {
      tubes.surface = *ToSurfaceMesh(assembly.mesh);
      tubes.report = assembly.report;
      tubes.paths = layout.paths;
      tubes.unions = assembly.unions;
      tubes.fallbacks.insert(tubes.fallbacks.end(), assembly.fallbacks.begin(),
                             assembly.fallbacks.end());
      return tubes;
    }
    if (turn + 1 == kTurns) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("tubes near ({:.4f}, {:.4f}, {:.4f}) m: {}; remove doubled or very "
                              "short edges there, or make the tubes a little thinner or thicker",
                              place.x(), place.y(), place.z(), assembly.failure));
    }
    tubes.fallbacks.push_back({place, static_cast<int>(layout.paths.size()), turn + 1,
                               "turned the polygons of all tubes (" + assembly.failure + ")"});
  }
}

}  // namespace curvefusion
