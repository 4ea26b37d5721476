#include "experiments/simulation/drift.h"

#include <gtest/gtest.h>

#include "kernel/error.h"

namespace curvefusion {
namespace {

constexpr double kRate = 30;

TEST(PoseSources, TruePosesStayAndOthersStartAtTheTruth) {
  const std::vector<RigidTransform> truth(30, RigidTransform(Eigen::Translation3d(1, 2, 3)));
  for (const RigidTransform& pose : DriftedPoses(truth, kRate, PoseErrorOf("true"), 1)) {
    EXPECT_EQ(pose.matrix(), truth[0].matrix());
  }
  for (const std::string& source : PoseSourceNames()) {
    const auto poses = DriftedPoses(truth, kRate, PoseErrorOf(source), 1);
    EXPECT_EQ(poses[0].matrix(), truth[0].matrix());
  }
}

TEST(PoseSources, ScaleMultipliesTheErrors) {
  const std::vector<RigidTransform> truth(30, RigidTransform::Identity());
  const auto once = DriftedPoses(truth, kRate, PoseErrorOf("ptam"), 1);
  const auto twice = DriftedPoses(truth, kRate, PoseErrorOf("ptam", 2), 1);
  // Rounding only.
  EXPECT_LT((twice[29].translation() - 2 * once[29].translation()).norm(), 1e-12);
}

TEST(PoseSources, UnknownNameIsRefused) { EXPECT_THROW(PoseErrorOf("slam"), Error); }

}  // namespace
}  // namespace curvefusion
