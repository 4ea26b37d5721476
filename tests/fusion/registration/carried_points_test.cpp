#include "fusion/registration/carried_points.h"

#include <gtest/gtest.h>

#include "tests/graph/noisy_wires.h"

namespace curvefusion {
namespace {

// Three wires at right angles, which determine every motion.
const std::vector<Polyline> kWires{
    {{0, 0, 0}, {0.15, 0, 0}}, {{0, 0, 0}, {0, 0.15, 0}}, {{0.15, 0, 0}, {0.15, 0, 0.15}}};

AlignmentResult Add(const ObservedPoints& bundle, CarriedPoints& carried) {
  return carried.AddBundle(bundle, ProjectToRidges(bundle, {}), RidgeProjectionOptions().spacing,
                           {});
}

RigidTransform Drift() {
  RigidTransform T = RigidTransform::Identity();
  T.translation() = Vec3(0.003, -0.002, 0.002);
  return T;
}

TEST(CarriedPoints, BundlesAreMovedBackAndTheRidgesStayOnTheWires) {
  CarriedPoints carried({});
  const ObservedPoints first = NoisyWires(kWires);
  Add(first, carried);
  EXPECT_GT(carried.ridges().size(), 100u);
  for (int bundle = 0; bundle < 2; ++bundle) {
    const AlignmentResult result = Add(Transformed(first, Drift()), carried);
    const RigidTransform left = result.T_target_source * Drift();
    // The same points on another grid: the ridges differ by a fraction of the noise, 1 mm.
    EXPECT_LT(left.translation().norm(), 0.0005);
  }
  EXPECT_GT(carried.ridges().size(), 200u);  // 450 mm of wire
  // A ridge turns sideways at an end, by up to a kernel's width.
  for (const Vec3& p : carried.ridges().positions) EXPECT_LT(DistanceTo(kWires, p), 0.004);
}

TEST(CarriedPoints, WiresThatOnlyALaterBundleShowsHaveRidges) {
  CarriedPoints carried({});
  Add(NoisyWires(kWires), carried);
  std::vector<Polyline> more = kWires;
  more.push_back({{0, 0.15, 0}, {0, 0.15, 0.15}});
  Add(NoisyWires(more), carried);
  int beside = 0;
  for (const Vec3& p : carried.ridges().positions) beside += DistanceTo({more.back()}, p) < 0.002;
  EXPECT_GT(beside, 60);  // 150 mm
}

TEST(CarriedPoints, EmptyBundlesChangeNothing) {
  CarriedPoints carried({});
  Add({}, carried);
  EXPECT_TRUE(carried.points().empty());
  Add(NoisyWires(kWires), carried);
  const size_t ridge_points = carried.ridges().size();
  const AlignmentResult result = Add({}, carried);
  EXPECT_TRUE(result.T_target_source.isApprox(RigidTransform::Identity()));
  EXPECT_NEAR(static_cast<double>(carried.ridges().size()), static_cast<double>(ridge_points),
              0.1 * static_cast<double>(ridge_points));
}

}  // namespace
}  // namespace curvefusion
