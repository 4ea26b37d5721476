#include "apps/hybrid_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "fusion/solid_parts/solid_parts.h"
#include "meshing/hybrid_mesh.h"
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

std::vector<std::string> WarningsOf(const SolidParts& parts, const HybridMesh& hybrid) {
  std::vector<std::string> warnings;
  if (parts.solids.empty()) {
    warnings.emplace_back(
        "the hybrid mesh holds the tubes alone: no surface was found that they are attached to");
  }
  if (hybrid.report.components > 1) {
    warnings.push_back(fmt::format("the hybrid mesh falls into {} pieces that do not touch",
                                   hybrid.report.components));
  }
  if (hybrid.resampled) {
    warnings.emplace_back(
        "the tubes and solid parts of the hybrid mesh were united on a grid of half the least "
        "radius: "
        "finer gaps and crotches are not to be relied on");
  }
  return warnings;
}

}  // namespace

HybridRecord WriteHybrid(const Reconstruction& reconstruction, const TubeOptions& options,
                         const std::filesystem::path& folder, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const SolidParts parts =
      FindSolidParts(reconstruction.sequence, reconstruction.skeleton, progress);
  const TubeMesh tubes = BuildTubes(parts.skeleton, options);
  const HybridMesh hybrid =
      UniteTubesAndSolids(ToTriangleMesh(tubes.surface), parts.solids,
                          LeastRadius(parts.skeleton, options.default_radius));
  WriteMesh(folder / "hybrid.ply", hybrid.mesh, {});
  WriteMesh(folder / "hybrid.stl", hybrid.mesh, {.unit = MeshUnit::kMillimetres});
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  return {.figures = hybrid.report,
          .seconds = seconds.count(),
          .parts = static_cast<int>(parts.solids.size()),
          .seen_area = parts.seen_area,
          .room_area = parts.room_area,
          .warnings = WarningsOf(parts, hybrid)};
}

}  // namespace curvefusion
