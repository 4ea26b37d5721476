#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>

#include "capture/sequence.h"
#include "kernel/camera.h"
#include "tests/temporary_path.h"

namespace curvefusion {

inline constexpr double kNetDepth = 0.6;   // metres, as depth shows it everywhere
inline constexpr double kSpacing = 0.012;  // of its wires
inline constexpr double kWire = 0.003;     // their diameter
inline const PinholeCamera kCamera = {320, 240, 400, 400, 159.5, 119.5};

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
inline bool IsInNet(double x, double y) { return std::abs(x) < 0.1 && std::abs(y) < 0.08; }

inline bool IsOnGrid(double x, double y, double spacing, double half_width) {
  const auto off = [&](double p) { return std::abs(p - spacing * std::round(p / spacing)); };
  return std::min(off(x), off(y)) < half_width;
}

inline constexpr double kBarsDepth = 0.45;  // metres, of bars that depth does not show
inline constexpr double kBarSpacing = 0.024;
inline constexpr double kBar = 0.003;  // their diameter

inline bool IsOnWire(double x, double y, double half_width) {
  return IsOnGrid(x, y, kSpacing, half_width);
}

// What hangs before a wall.
enum class Before { kNothing, kBlackBars };

// A camera that moves past a net before a wall at `wall_depth`: at kNetDepth it is painted on one.
class NetBefore {
 public:
  explicit NetBefore(double wall_depth, double lens_px = 0, Before before = Before::kNothing)
      : lens_px_(lens_px), before_(before) {
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
  // Every pixel is the mean of what lies in it, blurred as by a lens.
  cv::Mat ImageFrom(const Vec3& camera, double wall_depth) const {
    constexpr int kParts = 3;
    cv::Mat image(240, 320, CV_8UC3);
    for (int v = 0; v < 240; ++v) {
      for (int u = 0; u < 320; ++u) {
        cv::Vec3i sum;
        for (int part = 0; part < kParts * kParts; ++part) {
          sum += ColourAt(camera, wall_depth, u + (part % kParts - 1.0) / kParts,
                          v + (part / kParts - 1.0) / kParts);
        }
        image.at<cv::Vec3b>(v, u) = sum / (kParts * kParts);
      }
    }
    if (lens_px_ > 0) cv::GaussianBlur(image, image, {}, lens_px_);
    return image;
  }

  cv::Vec3b ColourAt(const Vec3& camera, double wall_depth, double u, double v) const {
    const Vec3 on_bars = camera + kCamera.Unproject(u, v, kBarsDepth);
    if (before_ == Before::kBlackBars &&
        IsOnGrid(on_bars.x(), on_bars.y(), kBarSpacing, kBar / 2)) {
      return {};
    }
    const Vec3 on_net = camera + kCamera.Unproject(u, v, kNetDepth);
    const Vec3 on_wall = camera + kCamera.Unproject(u, v, wall_depth);
    if (!IsInNet(on_net.x(), on_net.y())) return wallpaper_.At(on_net.x(), on_net.y());
    if (IsOnWire(on_net.x(), on_net.y(), kWire / 2)) return {90, 90, 90};
    return wallpaper_.At(on_wall.x(), on_wall.y());
  }

  std::filesystem::path folder_ = TemporaryPath("net");
  double lens_px_;  // standard deviation of its blur
  Before before_;
  Wallpaper wallpaper_;
  Sequence sequence_;
};

}  // namespace curvefusion
