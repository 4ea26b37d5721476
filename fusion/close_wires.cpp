#include "fusion/close_wires.h"

#include <algorithm>

namespace curvefusion {

namespace {

constexpr double kMaxMagnification = 2;

}  // namespace

double Magnification(double row_spacing, double resolved) {
  if (!(row_spacing > 0)) return 1;
  return std::clamp(resolved / row_spacing, 1.0, kMaxMagnification);
}

RidgeProjectionOptions ForCloseWires(RidgeProjectionOptions options, double magnification) {
  for (double* length : {&options.kernel_sigma, &options.max_sigma, &options.equalization_radius,
                         &options.spacing, &options.strength_radius, &options.contrast.ball_radius,
                         &options.contrast.flank_distance, &options.contrast.neighbourhood}) {
    *length /= magnification;
  }
  return options;
}

SkeletonGraph ExtractRidgeSkeleton(const ObservedPoints& points, const RidgeOptions& options,
                                   double magnification) {
  if (magnification == 1) return ExtractRidgeSkeleton(points, options);
  const AffineTransform magnify(Eigen::Scaling(magnification));
  return Transformed(ExtractRidgeSkeleton(Transformed(points, magnify), options),
                     magnify.inverse());
}

}  // namespace curvefusion
