#include "fusion/best/contraction_space.h"

#include "fusion/registration/ray_noise.h"

namespace curvefusion {

AffineTransform ContractionSpace::T_space_world(const ObservedPoints& points) const {
  return ray_noise_ratio > 1 ? NoiseMetric(points, ray_noise_ratio)
                             : AffineTransform(Eigen::Scaling(magnification));
}

SkeletonGraph ContractIn(const ContractionSpace& space, const ObservedPoints& points,
                         const std::optional<RidgePoints>& ridge, const RidgeOptions& options) {
  if (!space.IsWorld()) {
    return ExtractRidgeSkeleton(points, options, space.T_space_world(points));
  }
  return ridge ? ExtractRidgeSkeleton(points, *ridge, options)
               : ExtractRidgeSkeleton(points, options);
}

}  // namespace curvefusion
