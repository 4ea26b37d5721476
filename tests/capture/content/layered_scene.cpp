#include "tests/capture/content/layered_scene.h"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>
#include <random>

#include "tests/capture/sequence_fixture.h"

namespace curvefusion {

namespace {

constexpr int kRectangles = 7;

struct Rectangle {
  double left, right, top, bottom, depth;  // metres
  int grey;
};

std::vector<Rectangle> RandomRectangles(const LayeredScene& scene, std::mt19937& random) {
  const auto between = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / std::mt19937::max();
  };
  std::vector<Rectangle> rectangles;
  for (int i = 0; i < kRectangles; ++i) {
    const double depth = between(scene.nearest, scene.farthest);
    const double x = between(-0.5, 0.5) * depth, y = between(-0.4, 0.4) * depth;
    const double w = between(0.03, 0.15) * depth, h = between(0.03, 0.15) * depth;
    rectangles.push_back({x - w, x + w, y - h, y + h, depth, static_cast<int>(between(90, 250))});
  }
  return rectangles;
}

Rectangle Seen(const std::vector<Rectangle>& rectangles, const PinholeCamera& camera,
               const Vec3& center, int u, int v) {
  Rectangle nearest = {0, 0, 0, 0, 2.2, 40};
  for (const Rectangle& r : rectangles) {
    const Vec3 p = center + camera.Unproject(u, v, r.depth);
    if (r.depth < nearest.depth && p.x() > r.left && p.x() < r.right && p.y() > r.top &&
        p.y() < r.bottom) {
      nearest = r;
    }
  }
  return nearest;
}

void WriteImages(const LayeredScene& scene, const std::string& name, std::mt19937& random,
                 const std::filesystem::path& folder) {
  const std::vector<Rectangle> rectangles = RandomRectangles(scene, random);
  cv::Mat depth(scene.depth_camera.height, scene.depth_camera.width, CV_16UC1);
  cv::Mat color(scene.color_camera.height, scene.color_camera.width, CV_8UC3);
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      const double d = Seen(rectangles, scene.depth_camera, Vec3::Zero(), u, v).depth;
      depth.at<uint16_t>(v, u) = static_cast<uint16_t>(1000 * d);
      int grey = Seen(rectangles, scene.color_camera, -scene.offset, u, v).grey;
      if (scene.colour == SceneColour::kConstant) grey = 120;
      if (scene.colour == SceneColour::kNoise) grey = static_cast<int>(random() % 256);
      color.at<cv::Vec3b>(v, u) = cv::Vec3b(static_cast<uint8_t>(grey * 3 / 4),
                                            static_cast<uint8_t>(grey), static_cast<uint8_t>(grey));
    }
  }
  cv::imwrite((folder / "depth" / (name + ".png")).string(), depth);
  cv::imwrite((folder / "color" / (name + ".png")).string(), color);
}

}  // namespace

void WriteLayeredScene(const LayeredScene& scene, const std::filesystem::path& folder) {
  std::mt19937 random(7);
  std::filesystem::create_directories(folder / "depth");
  std::filesystem::create_directories(folder / "color");
  for (int i = 0; i < scene.frames; ++i) {
    const std::string name = fmt::format("{:06}", i);
    WriteImages(scene, name, random, folder);
    WriteText(folder / "pose" / (name + ".txt"),
              fmt::format("1 0 0 {}\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", 0.02 * i));
  }
  const PinholeCamera& camera = scene.depth_camera;
  WriteText(folder / "intrinsics.json",
            fmt::format(R"({{"width":{},"height":{},"fx":{},"fy":{},"cx":{},"cy":{}}})",
                        camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy));
}

}  // namespace curvefusion
