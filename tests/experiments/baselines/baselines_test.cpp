// Other methods on a small scan without noise, of which it is known what they give.
#include <gtest/gtest.h>

#include <filesystem>

#include "capture/sequence.h"
#include "experiments/baselines/lifted_edges.h"
#include "experiments/baselines/merged_skeleton.h"
#include "experiments/baselines/volumetric_fusion.h"
#include "experiments/metrics/evaluation.h"
#include "experiments/metrics/truth.h"
#include "experiments/simulation/simulate.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

class Baselines : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    SimulationOptions scan;
    scan.sensor = "ideal";
    scan.pose_source = "true";
    scan.object = "breadholder";
    scan.frames = 8;
    scan.motion.frame_rate = 10;
    SimulateScan(scan, Folder(), NoProgress);
  }
  static void TearDownTestSuite() { fs::remove_all(Folder()); }

  static fs::path Folder() { return TemporaryPath("baselines"); }
  const Sequence sequence_ = OpenSequence(Folder());
  const SkeletonGraph truth_ = ReadTruth(Folder() / "truth");
};

double RecallAt5mm(const Evaluation& evaluation) {
  return evaluation.raw.curves.within[2].recall.value_or(0);
}

TEST_F(Baselines, VolumeFusionOfFineVoxelsHoldsTheTubesAndOfCoarseOnesLess) {
  const auto f2 = [&](double voxel) {
    const TriangleMesh mesh = VolumeFusionSurface(sequence_, {.voxel_size = voxel}, NoProgress);
    return EvaluateMesh(mesh, truth_).raw.surface->within[1].F().value_or(0);
  };
  // Without noise 2 mm resolve a wire of 5 mm, of which one side is seen; 10 mm cannot.
  EXPECT_GT(f2(0.002), f2(0.01) + 0.1);
}

TEST_F(Baselines, KinectFusionTracksAndFusesInTheWorldOfTheFirstPose) {
  const KinectFusionResult result =
      FuseAsKinectFusion(sequence_, {.voxel_size = 0.005}, NoProgress);
  ASSERT_EQ(result.tracked.frame_count(), sequence_.frame_count());
  EXPECT_FALSE(result.surface.triangles.empty());
  double farthest = 0;
  for (int i = 0; i < sequence_.frame_count(); ++i) {
    const RigidTransform error =
        sequence_.frames[i].T_world_camera.inverse() * result.tracked.frames[i].T_world_camera;
    farthest = std::max(farthest, error.translation().norm());
  }
  EXPECT_LT(farthest, 0.01);  // a voxel of the tracker, over eight frames
}

TEST_F(Baselines, AllFramesContractedAtOnceAreTheWiresWhereNothingDrifts) {
  const SkeletonOfPoints result =
      SkeletonOfFrames(sequence_, {0, sequence_.frame_count()}, BranchStrategy::kExplicitJunctions,
                       PaperOptions(), NoProgress);
  EXPECT_FALSE(result.points.empty());
  // Half: eight frames see one side of the arches.
  EXPECT_GT(RecallAt5mm(Evaluate(result.skeleton, nullptr, truth_)), 0.5);
}

TEST_F(Baselines, ColourEdgesStayInTheBox) {
  const Eigen::AlignedBox3d box(Vec3(-0.05, -0.2, -0.2), Vec3(0.05, 0.2, 0.2));
  const SkeletonOfPoints result = SkeletonOfColourEdges(sequence_, box, PaperOptions(), NoProgress);
  ASSERT_FALSE(result.points.empty());
  for (const Vec3& p : result.points.positions) EXPECT_TRUE(box.contains(p));
}

TEST_F(Baselines, WithoutFramesThereIsNothing) {
  Sequence empty = sequence_;
  empty.frames.clear();
  EXPECT_TRUE(FuseAsKinectFusion(empty, {}, NoProgress).surface.triangles.empty());
  EXPECT_TRUE(
      SkeletonOfFrames(empty, {0, 0}, BranchStrategy::kBridgePoints, PaperOptions(), NoProgress)
          .skeleton.empty());
}

}  // namespace
}  // namespace curvefusion
