#include "fusion/curve_graph/stretch_evidence.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

// Three cameras at the origin before a wall at 1 m; at .6 m a bar of 6 mm goes across the middle.
class StretchEvidenceTest : public testing::Test {
 protected:
  static constexpr double kDepth = 0.6;

  StretchEvidenceTest() {
    std::filesystem::create_directories(folder_);
    sequence_.depth_camera = sequence_.color_camera = {320, 240, 300, 300, 160, 120};
    sequence_.depth_scale = 1000;
    for (int i = 0; i < 3; ++i) {
      SequenceFrame frame;
      frame.T_world_camera = RigidTransform::Identity();
      frame.depth_path = folder_ / fmt::format("{}.png", i);
      frame.color_path = folder_ / fmt::format("{}_color.png", i);
      sequence_.frames.push_back(frame);
      cv::Mat depth(240, 320, CV_16U, cv::Scalar(1000));
      depth(cv::Rect(0, 119, 320, 3)) = 598;
      cv::imwrite(frame.depth_path.string(), depth);
      cv::imwrite(frame.color_path.string(), cv::Mat(240, 320, CV_8UC3, cv::Scalar(90, 90, 90)));
    }
    Polyline points;
    for (int i = 0; i <= 40; ++i) points.emplace_back(-0.1 + 0.005 * i, 0, kDepth);
    edge_ = skeleton_.AddPolyline(points);
  }
  ~StretchEvidenceTest() override { std::filesystem::remove_all(folder_); }

  std::vector<StretchEvidence> Collect() const {
    return CollectEvidence(skeleton_, radii_, sequence_, 60, skeleton_);
  }

  std::filesystem::path folder_ = TemporaryPath("stretch_evidence");
  Sequence sequence_;
  SkeletonGraph skeleton_;
  EdgeId edge_ = 0;
  RadiusEstimate radii_;
};

TEST_F(StretchEvidenceTest, StretchesFollowOneAnother) {
  const auto all = Collect();
  ASSERT_EQ(all.size(), 5u);  // 200 mm
  EXPECT_EQ(all.front().part.first, 0u);
  EXPECT_EQ(all.back().part.last, 40u);
  for (size_t i = 1; i < all.size(); ++i) EXPECT_EQ(all[i].part.first, all[i - 1].part.last);
}

TEST_F(StretchEvidenceTest, OfAWireBothSidesAreOpen) {
  for (const StretchEvidence& stretch : Collect()) {
    EXPECT_EQ(stretch.images, 3);
    EXPECT_EQ(stretch.directions, 1);
    EXPECT_DOUBLE_EQ(stretch.seen, 1);
    EXPECT_DOUBLE_EQ(stretch.open, 1);
    EXPECT_DOUBLE_EQ(stretch.same, 0);
    EXPECT_NEAR(stretch.width, 0.006, 1e-9);
  }
}

TEST_F(StretchEvidenceTest, OneOfTheImagesLooksPastACurveThatIsNotThere) {
  cv::imwrite(sequence_.frames[1].depth_path.string(), cv::Mat(240, 320, CV_16U, cv::Scalar(1000)));
  for (const StretchEvidence& stretch : Collect()) {
    EXPECT_NEAR(stretch.seen, 2.0 / 3, 1e-12);
    EXPECT_NEAR(stretch.past, 1.0 / 3, 1e-12);
  }
}

TEST_F(StretchEvidenceTest, StripsCoverWhatIsNearThem) {
  radii_.edges = {{edge_, 0.003, 0.0001, 2, {}}};
  radii_.strips = {{edge_, 0.02, 0, 0.006}, {edge_, 0.06, 0, 0.012}};  // the second is too wide
  const auto all = Collect();
  EXPECT_NEAR(all[0].coverage, 0.3, 0.11);  // 12 of 40 mm, looked at every 4 mm
  EXPECT_EQ(all[1].coverage, 0);
  EXPECT_DOUBLE_EQ(all[0].diameter, 0.006);
}

TEST_F(StretchEvidenceTest, ATableHoldsEveryStretch) {
  const std::string table = EvidenceCsv(skeleton_, Collect());
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 6);
  const size_t header_end = table.find('\n');
  const std::string header = table.substr(0, header_end);
  const std::string row = table.substr(header_end + 1, table.find('\n', header_end + 1));
  EXPECT_EQ(
      std::count(header.begin(), header.end(), ','),
      std::count(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(row.find('\n')), ','));
}

TEST_F(StretchEvidenceTest, OfNoCurvesIsNone) {
  EXPECT_TRUE(CollectEvidence({}, {}, sequence_, 60, {}).empty());
}

}  // namespace
}  // namespace curvefusion
