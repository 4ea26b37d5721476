#include "experiments/simulation/drift.h"

#include <gtest/gtest.h>

#include <numbers>

#include "experiments/metrics/trajectory_metrics.h"
#include "experiments/simulation/motion.h"
#include "kernel/error.h"

namespace curvefusion {
namespace {

constexpr int kFrames = 750;
constexpr double kRate = 30;

// Published accuracies of such trackers on hand-held scans of about this length.
struct KnownAccuracy {
  const char* source;
  double ate_mm;  // after one rigid alignment
  double rpe_mm;  // over 1 s
  double rpe_degree;
};

class Drift : public testing::TestWithParam<KnownAccuracy> {};

TEST_P(Drift, HasTheKnownAccuracy) {
  constexpr int kSeeds = 20;
  constexpr int kSecond = 30;
  double ate = 0, rpe = 0, rpe_angle = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    ScanTask task;
    task.object_bounds.extend(Vec3::Constant(-0.1)).extend(Vec3::Constant(0.1));
    const auto truth = HandheldPath(task, kFrames, {}, seed);
    const auto estimate = DriftedPoses(truth, kRate, PoseErrorOf(GetParam().source), seed);
    ate += AbsoluteTrajectoryError(estimate, truth) / kSeeds;
    const RelativePoseError relative = RelativePoseErrors(estimate, truth, kSecond);
    rpe += relative.translation / kSeeds;
    rpe_angle += relative.rotation / kSeeds;
  }
  // 20 %: the published figures depend on the scan's length and motion by that much.
  EXPECT_NEAR(ate * 1e3, GetParam().ate_mm, 0.2 * GetParam().ate_mm);
  EXPECT_NEAR(rpe * 1e3, GetParam().rpe_mm, 0.2 * GetParam().rpe_mm);
  EXPECT_NEAR(rpe_angle * 180 / std::numbers::pi, GetParam().rpe_degree,
              0.2 * GetParam().rpe_degree);
}

INSTANTIATE_TEST_SUITE_P(Trackers, Drift,
                         testing::Values(KnownAccuracy{"orbslam2", 4.8, 3.5, 0.20},
                                         KnownAccuracy{"bundlefusion", 5.3, 3.5, 0.20},
                                         KnownAccuracy{"kinfu", 6.3, 3.7, 0.18},
                                         KnownAccuracy{"ptam", 18.8, 14.9, 0.93}),
                         [](const auto& test) { return test.param.source; });

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
