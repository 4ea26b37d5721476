#pragma once

#include <string>

#include "graph/skeleton_graph.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// How the curves of a cloud are found.
enum class CloudMethod {
  kAuto,   ///< by the thickness of the cloud
  kRidge,  ///< density ridges, for wires of 2 to 12 mm, also close ones
  kL1,     ///< the paper's L1 axis, for any size
};

/// The method of the name "auto", "ridge" or "l1". Throws Error(kUsage) for another.
CloudMethod CloudMethodNamed(const std::string& name);

struct CloudCurveOptions {
  CloudMethod method = CloudMethod::kAuto;
  double neighbourhood = 0;  ///< m, first radius of kL1, about three times the wires' thickness;
                             ///< 0 = from the cloud
  double radius = 0;         ///< m, of the wires, stored with the curves; 0 = unknown
};

/// The curves of a cloud of thin structures, in metres. Where the radius is given and points have
/// viewing rays, they are moved from the wires' surface to the axis first. Empty where there is
/// nothing curve-like. Throws Error(kBadInput) for a point that is not finite.
SkeletonGraph CurvesOfCloud(const ObservedPoints& points, const CloudCurveOptions& options);

}  // namespace curvefusion
