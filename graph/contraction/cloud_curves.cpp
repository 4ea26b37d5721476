#include "graph/contraction/cloud_curves.h"

#include <numbers>

#include "graph/contraction/l1_contraction.h"
#include "graph/contraction/ridge_skeleton.h"
#include "graph/contraction/suggested_radius.h"
#include "graph/set_radius.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

// The ridge kernel is made for wires of 2 to 12 mm, whose suggested neighbourhood is about 15 mm;
// the L1 axis adapts to clouds that are this many times larger or smaller. Chosen: 2 and 12 mm are
// 2.4 times below and above their geometric mean.
constexpr double kRidgeNeighbourhood = 0.015;
constexpr double kRidgeSizeRange = 2.5;

SkeletonGraph ExtractL1(const ObservedPoints& points, double neighbourhood) {
  const double radius = neighbourhood > 0 ? neighbourhood : SuggestedRadius(points);
  return radius > 0 ? ExtractL1Skeleton(points, OptionsForRadius(radius)) : SkeletonGraph();
}

bool HasUsualSize(const ObservedPoints& points) {
  const double ratio = SuggestedRadius(points) / kRidgeNeighbourhood;
  return ratio < kRidgeSizeRange && ratio > 1 / kRidgeSizeRange;
}

bool UsesRidges(const ObservedPoints& points, CloudMethod method) {
  return method == CloudMethod::kRidge || (method == CloudMethod::kAuto && HasUsualSize(points));
}

}  // namespace

CloudMethod CloudMethodNamed(const std::string& name) {
  if (name == "auto") return CloudMethod::kAuto;
  if (name == "ridge") return CloudMethod::kRidge;
  if (name == "l1") return CloudMethod::kL1;
  throw Error(ErrorKind::kUsage, "there is no method " + name + "; name auto, ridge or l1");
}

// Points of a depth camera lie on the near side of a wire, pi/4 radii before its axis on average.
SkeletonGraph CurvesOfCloud(const ObservedPoints& points, const CloudCurveOptions& options) {
  RequireFinitePositions(points);
  const ObservedPoints axis_points = ShiftAlongRays(points, std::numbers::pi / 4 * options.radius);
  SkeletonGraph graph = UsesRidges(axis_points, options.method)
                            ? ExtractRidgeSkeleton(axis_points, {})
                            : ExtractL1(axis_points, options.neighbourhood);
  if (options.radius > 0) SetRadius(options.radius, graph);
  return graph;
}

}  // namespace curvefusion
