#include "meshing/tube_warnings.h"

#include <fmt/format.h>

namespace curvefusion {

std::vector<std::string> TubeWarnings(const SkeletonGraph& skeleton, const TubeMesh& tubes,
                                      const TubeOptions& options) {
  std::vector<std::string> warnings;
  int unknown = 0;
  for (const EdgeId edge : skeleton.Edges()) unknown += skeleton.edge(edge).radii.empty() ? 1 : 0;
  if (unknown > 0) {
    warnings.push_back(fmt::format(
        "the thickness of {} of {} curves is unknown; {:g} mm was assumed for the mesh "
        "(`mesh --radius 2.5` sets all, `reconstruct --set tubes.default_radius=0.0025` "
        "these)",
        unknown, skeleton.edge_count(), 2 * options.default_radius / kMillimetre));
  }
  for (const TubeFallback& fallback : tubes.fallbacks) {
    const Vec3& p = fallback.position;
    const std::string how = fallback.attempts > 0 ? fmt::format("took {} attempts: {}",
                                                                fallback.attempts, fallback.remedy)
                                                  : "were " + fallback.remedy;
    warnings.push_back(fmt::format("the {} tubes that meet at ({:.3f}, {:.3f}, {:.3f}) m {}",
                                   fallback.tubes, p.x(), p.y(), p.z(), how));
  }
  return warnings;
}

}  // namespace curvefusion
