#include "apps/hybrid_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "fusion/solid_parts/solid_parts.h"
#include "meshing/io/mesh_io.h"

namespace curvefusion {

namespace {

double LeastRadius(const SkeletonGraph& skeleton, double default_radius) {
  double least = default_radius;
  for (const EdgeId id : skeleton.Edges()) {
    for (const double radius : skeleton.edge(id).radii) least = std::min(least, radius);
  }
  return least;
}

}  // namespace

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

HybridRecord WriteHybrid(const Reconstruction& reconstruction, const TubeOptions& options,
                         const std::filesystem::path& folder, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const SolidParts parts =
      FindSolidParts(reconstruction.sequence, reconstruction.skeleton, progress);
  const HybridMesh hybrid = UniteWithSolids(parts.skeleton, BuildTubes(parts.skeleton, options),
                                            parts.solids, options.default_radius);
  WriteMesh(folder / "hybrid.ply", hybrid.mesh, {});
  WriteMesh(folder / "hybrid.stl", hybrid.mesh, {.unit = MeshUnit::kMillimetres});
  std::vector<std::string> warnings = HybridWarnings(hybrid);
  if (parts.solids.empty()) {
    warnings.emplace_back(
        "the hybrid mesh holds the tubes alone: no surface was found that they are attached to");
  } else {
    const HybridMesh solids =
        UniteWithSolids(parts.skeleton, {}, parts.solids, options.default_radius);
    WriteMesh(folder / "solid_parts.ply", solids.mesh, {});
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  return {.figures = hybrid.report,
          .seconds = seconds.count(),
          .parts = static_cast<int>(parts.solids.size()),
          .seen_area = parts.seen_area,
          .room_area = parts.room_area,
          .warnings = std::move(warnings)};
}

}  // namespace curvefusion
