#include "apps/hybrid_result.h"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "fusion/solid_parts/solid_parts.h"
#include "meshing/hybrid_mesh.h"
#include "meshing/io/mesh_io.h"

namespace curvefusion {

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
