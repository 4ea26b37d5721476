#include "fusion/silhouettes/colour_pruning.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <optional>

#include "fusion/appearance/wire_posterior.h"
#include "tests/fusion/wire_images.h"

namespace curvefusion {
namespace {

constexpr int kFrames = 12;
constexpr int kWires = 4;
constexpr double kSpacing = 0.012;
constexpr double kDepth = 0.5;
constexpr double kCrossbar = 0.03;  // where it lies along the wires
constexpr double kRadius = 0.0025;
const PinholeCamera kCamera{320, 240, 480, 480, 159.5, 119.5};

double Place(int wire) { return (wire - 0.5 * (kWires - 1)) * kSpacing; }

// A row of upright wires that a crossbar joins.
std::vector<RenderedWire> Grille() {
  const Rgb color{60, 160, 70};
  std::vector<RenderedWire> wires = {
      {{Place(0), kCrossbar, kDepth}, {Place(kWires - 1), kCrossbar, kDepth}, 2 * kRadius, color}};
  for (int i = 0; i < kWires; ++i) {
    wires.push_back({{Place(i), -0.06, kDepth}, {Place(i), 0.06, kDepth}, 2 * kRadius, color});
  }
  return wires;
}

RigidTransform Pose(int frame) {
  RigidTransform T = RigidTransform::Identity();
  T.linear() =
      Eigen::AngleAxisd(0.05 * (frame - kFrames / 2), Vec3(0.5, 1, 0).normalized()).matrix();
  T.translation() = Vec3(0, 0, kDepth) - T.linear() * Vec3(0, 0, kDepth);
  return T;
}

// Images of the grille, and the colours that they have been made of.
class ColourPruningTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::filesystem::temp_directory_path() /
              fmt::format("curvefusion_colour_pruning_{}", getpid());
    std::filesystem::create_directories(folder_);
    cv::imwrite((folder_ / "depth.png").string(), cv::Mat::zeros(240, 320, CV_16U));
    WireColourModel model;
    for (int i = 0; i < kFrames; ++i) {
      const ColorImage image = RenderWires(Grille(), kCamera, Pose(i), 0.8);
      const ColourBins bins = BinColours(image);
      for (int v = 0; v < image.height(); ++v) {
        for (int u = 0; u < image.width(); ++u) {
          const Rgb color = image(u, v);  // greenish, which the background is not
          if (color[1] > color[0] + 60) {
            model.AddWire(bins(u, v));
          } else {
            model.AddBackground(bins(u, v));
          }
        }
      }
      WriteImage(folder_ / fmt::format("{}.png", i), image);
    }
    colours_.posterior = model.Posterior();
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder_); }

  static Sequence Scan() {
    Sequence sequence;
    sequence.depth_camera = sequence.color_camera = kCamera;
    sequence.depth_scale = 1000;
    for (int i = 0; i < kFrames; ++i) {
      SequenceFrame frame;
      frame.timestamp = i;
      frame.T_world_camera = Pose(i);
      frame.color_path = folder_ / fmt::format("{}.png", i);
      frame.depth_path = folder_ / "depth.png";
      sequence.frames.push_back(frame);
    }
    return sequence;
  }

  // The wires, joined at the places y by rungs from wire to wire.
  static SkeletonGraph Row(const std::vector<double>& rungs) {
    std::vector<double> places = rungs;
    places.insert(places.begin(), -0.055);
    places.push_back(0.055);
    SkeletonGraph graph;
    std::array<std::vector<NodeId>, kWires> nodes;
    const auto connect = [&](NodeId a, NodeId b) {
      SkeletonEdge edge{{a, b}, Resample({graph.position(a), graph.position(b)}, 0.001), {}, {}};
      edge.radii.assign(edge.points.size(), kRadius);
      graph.AddEdge(std::move(edge));
    };
    for (int wire = 0; wire < kWires; ++wire) {
      for (size_t i = 0; i < places.size(); ++i) {
        nodes[wire].push_back(graph.AddNode({Place(wire), places[i], kDepth}));
        if (i > 0) connect(nodes[wire][i - 1], nodes[wire][i]);
        const bool is_rung = i > 0 && i + 1 < places.size();
        if (is_rung && wire > 0) connect(nodes[wire - 1][i], nodes[wire][i]);
      }
    }
    return graph;
  }

  inline static std::filesystem::path folder_;
  inline static WireColours colours_;
};

TEST_F(ColourPruningTest, DropsWhatCrossesGapsAndKeepsTheCrossbar) {
  SkeletonGraph graph = Row({-0.02, kCrossbar});
  const std::optional<double> removed = PruneByColour(Scan(), colours_, {}, graph);
  ASSERT_TRUE(removed.has_value());
  EXPECT_NEAR(*removed, (kWires - 1) * kSpacing, 0.001);
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_EQ(graph.CycleRank(), 0);
}

TEST_F(ColourPruningTest, ShiftsTheImagesAsColoursWereSeen) {
  Sequence scan = Scan();
  scan.color_camera.cx += 4;  // colours are seen as far to the left of where this projects
  SkeletonGraph unshifted = Row({-0.02});
  EXPECT_EQ(PruneByColour(scan, colours_, {}, unshifted),
            std::nullopt);  // curves beside their wires
  WireColours shifted = colours_;
  shifted.shift_px = {-4, 0};
  SkeletonGraph graph = Row({-0.02});
  EXPECT_NEAR(PruneByColour(scan, shifted, {}, graph).value(), (kWires - 1) * kSpacing, 0.001);
}

}  // namespace
}  // namespace curvefusion
