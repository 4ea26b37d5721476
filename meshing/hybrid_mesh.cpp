#include "meshing/hybrid_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "kernel/error.h"
#include "meshing/junction_mesh.h"
#include "meshing/union_resampling.h"

namespace curvefusion {

namespace {

constexpr int kAttempts = 4;  // measured: scans have needed one or two
// In radii: a tube has a dozen corners on such a grid (junction_mesh).
constexpr double kResampling = 0.5;

double LeastRadius(const SkeletonGraph& skeleton, double default_radius) {
  double least = default_radius;
  for (const EdgeId id : skeleton.Edges()) {
    for (const double radius : skeleton.edge(id).radii) least = std::min(least, radius);
  }
  return least;
}

}  // namespace

HybridMesh UniteTubesAndSolids(const TriangleMesh& tubes, const std::vector<TriangleMesh>& solids,
                               double radius) {
  Junction junction{{}, {}, radius};
  if (!tubes.triangles.empty()) junction.stubs.push_back(tubes);
  for (const TriangleMesh& solid : solids) {
    if (!solid.triangles.empty()) junction.stubs.push_back(solid);
  }
  HybridMesh hybrid;
  if (junction.stubs.size() == 1) hybrid.mesh = junction.stubs.front();
  if (junction.stubs.size() > 1) {
    JunctionMesh united = MeshJunction(junction, {kAttempts, false}, 0);
    hybrid.attempts = united.attempts;
    hybrid.resampled = !united.surface;
    hybrid.mesh = united.surface ? std::move(*united.surface)
                                 : ResampleUnion(junction.stubs, kResampling * radius);
  }
  hybrid.report = ExamineMesh(hybrid.mesh);
  if (hybrid.report.IsWatertight()) return hybrid;
  throw Error(ErrorKind::kBadInput, fmt::format("the tubes and the solid parts do not unite: {}",
                                                hybrid.report.Defects()));
}

HybridMesh UniteWithSolids(const SkeletonGraph& skeleton, const TubeMesh& tubes,
                           const std::vector<TriangleMesh>& solids, double default_radius) {
  return UniteTubesAndSolids(ToTriangleMesh(tubes.surface), solids,
                             LeastRadius(skeleton, default_radius));
}

std::vector<std::string> HybridWarnings(const HybridMesh& hybrid) {
  std::vector<std::string> warnings;
  if (hybrid.report.components > 1) {
    warnings.push_back(fmt::format("the hybrid mesh falls into {} pieces that do not touch",
                                   hybrid.report.components));
  }
  if (hybrid.resampled) {
    warnings.emplace_back(
        "the tubes and solid parts of the hybrid mesh were united on a grid of half the least "
        "radius: finer gaps and crotches are not to be relied on");
  }
  return warnings;
}

}  // namespace curvefusion
