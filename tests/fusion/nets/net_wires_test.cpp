#include "fusion/nets/net_wires.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <string>

#include "fusion/segmentation/segmentation.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

constexpr double kNetDepth = 0.6;   // metres, as depth shows it everywhere
constexpr double kSpacing = 0.012;  // of its wires
constexpr double kWire = 0.003;     // their diameter
const PinholeCamera kCamera = {320, 240, 400, 400, 159.5, 119.5};

// Soft spots of all colours on a plane, the same each time.
class Wallpaper {
 public:
  Wallpaper() {
    std::mt19937 random(7);
    for (cv::Vec3b& spot : spots_)
      for (int k = 0; k < 3; ++k) spot[k] = static_cast<uint8_t>(40 + random() % 176);
  }
  cv::Vec3b At(double x, double y) const {
    constexpr double kSpot = 0.02;
    const double u = x / kSpot + 32, v = y / kSpot + 32;
    const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
    const double a = u - u0, b = v - v0;
    cv::Vec3b colour;
    for (int k = 0; k < 3; ++k) {
      colour[k] =
          static_cast<uint8_t>((1 - b) * ((1 - a) * Spot(u0, v0)[k] + a * Spot(u0 + 1, v0)[k]) +
                               b * ((1 - a) * Spot(u0, v0 + 1)[k] + a * Spot(u0 + 1, v0 + 1)[k]));
    }
    return colour;
  }

 private:
  const cv::Vec3b& Spot(int u, int v) const { return spots_[(v & 63) * 64 + (u & 63)]; }
  std::array<cv::Vec3b, 64 * 64> spots_;
};

// The net spans an opening in a board.
bool IsInNet(double x, double y) { return std::abs(x) < 0.1 && std::abs(y) < 0.08; }

bool IsOnWire(double x, double y, double half_width) {
  const auto off = [](double p) { return std::abs(p - kSpacing * std::round(p / kSpacing)); };
  return std::min(off(x), off(y)) < half_width;
}

// A camera that moves past a net before a wall at `wall_depth`: at kNetDepth it is painted on one.
class NetBefore {
 public:
  explicit NetBefore(double wall_depth) {
    std::filesystem::create_directories(folder_);
    cv::imwrite((folder_ / "depth.png").string(),
                cv::Mat(240, 320, CV_16U, cv::Scalar(5000 * kNetDepth)));
    sequence_.depth_camera = sequence_.color_camera = kCamera;
    for (int i = 0; i < 12; ++i) {
      SequenceFrame frame;
      frame.T_world_camera = RigidTransform::Identity();
      frame.T_world_camera.translation() = Vec3(0.006 * i - 0.03, 0.003 * i, 0);
      frame.color_path = folder_ / (std::to_string(i) + ".png");
      frame.depth_path = folder_ / "depth.png";
      cv::imwrite(frame.color_path.string(),
                  ImageFrom(frame.T_world_camera.translation(), wall_depth));
      sequence_.frames.push_back(frame);
    }
  }
  ~NetBefore() { std::filesystem::remove_all(folder_); }
  NetBefore(const NetBefore&) = delete;
  NetBefore& operator=(const NetBefore&) = delete;

  const Sequence& sequence() const { return sequence_; }

 private:
  cv::Mat ImageFrom(const Vec3& camera, double wall_depth) const {
    cv::Mat image(240, 320, CV_8UC3);
    for (int v = 0; v < 240; ++v) {
      for (int u = 0; u < 320; ++u) {
        const Vec3 on_net = camera + kCamera.Unproject(u, v, kNetDepth);
        const Vec3 on_wall = camera + kCamera.Unproject(u, v, wall_depth);
        cv::Vec3b& pixel = image.at<cv::Vec3b>(v, u);
        if (!IsInNet(on_net.x(), on_net.y()))
          pixel = wallpaper_.At(on_net.x(), on_net.y());
        else if (IsOnWire(on_net.x(), on_net.y(), kWire / 2))
          pixel = {90, 90, 90};
        else
          pixel = wallpaper_.At(on_wall.x(), on_wall.y());
      }
    }
    return image;
  }

  std::filesystem::path folder_ = TemporaryPath("net");
  Wallpaper wallpaper_;
  Sequence sequence_;
};

TEST(NetWires, WiresOfANetThatDepthShowsAsASurfaceAreFound) {
  const NetBefore net(1.2);
  const Nets nets = FindNets(net.sequence());
  ASSERT_FALSE(nets.empty());
  EXPECT_NEAR(nets.spacing, kSpacing, 0.2 * kSpacing);
  int found = 0, on_wire = 0;
  double off_depth = 0;
  for (const NetWires& wires : FindNetWires(net.sequence(), 0, 12, nets)) {
    for (int v = 0; v < wires.mask.height(); ++v) {
      for (int u = 0; u < wires.mask.width(); ++u) {
        if (!wires.mask(u, v)) continue;
        const Vec3 p =
            wires.T_world_camera * kCamera.Unproject(u, v, static_cast<double>(wires.depth(u, v)));
        off_depth += std::abs(p.z() - kNetDepth);
        ++found;
        on_wire += IsOnWire(p.x(), p.y(), kWire / 2 + 0.001);
      }
    }
  }
  EXPECT_GT(found, 20000);
  EXPECT_GT(on_wire, 0.9 * found);
  EXPECT_LT(off_depth, 0.004 * found);  // by steps of 2 mm
}

// In a volume of nothing, so that depth shows nothing thin.
TEST(NetWires, BundlesHoldThem) {
  const NetBefore net(1.2);
  SegmentationOptions options;
  options.difference.accept_where_nothing_rendered = false;
  SegmentationModel model;
  const TsdfVolume volume{TsdfOptions{}};
  const auto segment = [&] {
    return SegmentBundle(net.sequence(), 0, 12, volume, model, options, [] {});
  };
  EXPECT_TRUE(segment().points.empty());
  model.nets = FindNets(net.sequence());
  const SegmentedBundle bundle = segment();
  EXPECT_GT(bundle.points.size(), 2000u);
  EXPECT_EQ(bundle.frames.size(), 12u);
  for (const Vec3& p : bundle.points.positions) EXPECT_NEAR(p.z(), kNetDepth, 0.01);
}

TEST(NetWires, ANetPaintedOnASurfaceIsNone) {
  EXPECT_TRUE(FindNets(NetBefore(kNetDepth).sequence()).empty());
}

TEST(NetWires, FewFramesTellNothing) {
  const NetBefore net(1.2);
  Sequence sequence = net.sequence();
  sequence.frames.resize(3);
  EXPECT_TRUE(FindNets(sequence).empty());
}

}  // namespace
}  // namespace curvefusion
