#include "experiments/studies/recording_figures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "experiments/simulation/scan_files.h"
#include "experiments/studies/recording_checks.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 36;
const PinholeCamera kCamera{320, 240, 290, 290, 159.5, 119.5};

// A recording of one depth image from a camera at rest, as the product reads it.
class Recording {
 public:
  explicit Recording(const DepthImage& depth) {
    for (const char* part : {"depth", "rgb"}) fs::create_directories(folder_ / part);
    std::vector<std::string> names;
    for (int i = 0; i < kFrames; ++i) {
      names.push_back(FrameName(i, 30));
      WriteDepthPng(folder_ / "depth" / (names.back() + ".png"), depth);
    }
    sequence.depth_camera = sequence.color_camera = kCamera;
    sequence.depth_scale = kDepthScale;
    for (const std::string& name : names) {
      SequenceFrame frame;
      frame.name = name;
      frame.T_world_camera = RigidTransform::Identity();
      frame.depth_path = folder_ / "depth" / (name + ".png");
      sequence.frames.push_back(frame);
    }
  }

  Sequence sequence;

 private:
  TemporaryFolder folder_{"recording_figures"};
};

void Fill(DepthImage& image, int u, int v, int width, int height, float value) {
  for (int y = v; y < v + height; ++y) std::fill_n(image.row(y) + u, width, value);
}

// A wall at 1.6 m; a box at .8 m with the shadow of a projector to its right, 290 * .075 * .625 =
// 14 px wide, on its left; a speck of 3x3 in front of the wall, one of 5x5 behind the box's edge.
DepthImage Desk() {
  DepthImage depth(kCamera.width, kCamera.height, 1.6F);
  Fill(depth, 100, 60, 80, 100, 0.8F);
  Fill(depth, 86, 60, 14, 100, 0);
  Fill(depth, 220, 40, 3, 3, 1.2F);
  Fill(depth, 260, 40, 5, 5, 1.9F);
  return depth;
}

TEST(RecordingFigures, CountSpecksAndShadows) {
  const Recording recording(Desk());
  const auto figures = DepthFigures(recording.sequence);
  EXPECT_NEAR(figures.at("measured"), 1 - 14.0 * 100 / (320 * 240), 1e-9);
  EXPECT_EQ(figures.at("small"), 9);
  EXPECT_EQ(figures.at("front"), 9);
  EXPECT_NEAR(figures.at("components_6_20"), 1, 1e-9);
  EXPECT_NEAR(figures.at("components_21_160"), 1, 1e-9);
  EXPECT_EQ(figures.at("shadow_left"), 1);
  EXPECT_NEAR(figures.at("shadow_width"), 14 / 13.6, 0.01);
}

// True poses agree; errors along the ray move depth by as much.
TEST(RecordingFigures, DisagreementIsThatOfThePoses) {
  Recording recording(DepthImage(kCamera.width, kCamera.height, 1.6F));
  EXPECT_NEAR(DisagreementFigures(recording.sequence, nullptr, 1).at("disagree_1.6"), 0, 1e-3);
  for (int i = 0; i < kFrames; ++i) {
    recording.sequence.frames[i].T_world_camera.translation().z() = 0.0002 * i;
  }
  EXPECT_NEAR(DisagreementFigures(recording.sequence, nullptr, 1).at("disagree_1.6"), 6, 0.01);
  const PoseErrorModel kitchen = PoseErrorOf("kitchen");
  EXPECT_GT(DisagreementFigures(recording.sequence, &kitchen, 1).at("disagree_1.6"), 1);
}

TEST(RecordingChecks, RealFoldersAreMeasuredAlongside) {
  StudyRequest request;
  request.seeds = 1;
  const size_t simulated = RecordingCases(request).size();
  request.scans = {"/scans/kitchen"};
  const std::vector<StudyCase> cases = RecordingCases(request);
  ASSERT_EQ(cases.size(), simulated + 1);
  EXPECT_TRUE(IsRecording(cases.back()));
  EXPECT_FALSE(cases.back().scan);
  EXPECT_EQ(LabelOf(cases.back().labels, "folder"), "/scans/kitchen");
}

}  // namespace
}  // namespace curvefusion
