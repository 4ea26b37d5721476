#include "apps/demo_scan.h"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "apps/demo_scene.h"
#include "kernel/atomic_file.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

constexpr double kDepthScale = 5000;    // units per metre, as in the TUM benchmark
constexpr double kFocalPerWidth = 0.9;  // about that of a Kinect V1
constexpr double kFrameRate = 30;

PinholeCamera DemoCamera(const DemoScanOptions& options) {
  const double focal = kFocalPerWidth * options.width;
  return {options.width, options.height,           focal,
          focal,         (options.width - 1) / 2., (options.height - 1) / 2.};
}

void WriteImage(const fs::path& path, const cv::Mat& image) {
  WriteFileAtomically(path, [&](const fs::path& temporary) {
    const std::vector<int> parameters = {cv::IMWRITE_JPEG_QUALITY, 95, cv::IMWRITE_PNG_COMPRESSION,
                                         1};
    if (!cv::imwrite(temporary.string(), image, parameters)) {
      throw Error(ErrorKind::kResource, path.string() + ": cannot be written");
    }
  });
}

void WriteText(const fs::path& path, const std::string& text) {
  WriteStreamAtomically(path, [&](std::ostream& stream) { stream << text; });
}

void WriteFrame(const fs::path& folder, const std::string& name, const DemoFrame& frame) {
  cv::Mat depth(frame.depth.height(), frame.depth.width(), CV_16U);
  cv::Mat color(frame.color.height(), frame.color.width(), CV_8UC3);
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      depth.at<uint16_t>(v, u) =
          cv::saturate_cast<uint16_t>(static_cast<double>(frame.depth(u, v)) * kDepthScale);
      const Rgb& rgb = frame.color(u, v);
      color.at<cv::Vec3b>(v, u) = {rgb[2], rgb[1], rgb[0]};
    }
  }
  WriteImage(folder / "depth" / (name + ".png"), depth);
  WriteImage(folder / "rgb" / (name + ".jpg"), color);
}

std::string TrajectoryLine(const std::string& time, const RigidTransform& T_world_camera) {
  const Vec3 t = T_world_camera.translation();
  const Eigen::Quaterniond q(T_world_camera.linear());
  return fmt::format("{} {:.6f} {:.6f} {:.6f} {:.7f} {:.7f} {:.7f} {:.7f}\n", time, t.x(), t.y(),
                     t.z(), q.x(), q.y(), q.z(), q.w());
}

std::string IntrinsicsJson(const PinholeCamera& camera) {
  return fmt::format(
      "{{\"width\": {}, \"height\": {}, \"fx\": {}, \"fy\": {}, \"cx\": {}, \"cy\": {}, "
      "\"depth_scale\": {}}}\n",
      camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy, kDepthScale);
}

}  // namespace

void WriteDemoScan(const fs::path& folder, const DemoScanOptions& options,
                   const Progress& progress) {
  std::error_code failure;
  fs::create_directories(folder / "rgb", failure);
  fs::create_directories(folder / "depth", failure);
  if (failure) {
    throw Error(ErrorKind::kResource,
                fmt::format("{}: cannot be made ({})", folder.string(), failure.message()));
  }
  const PinholeCamera camera = DemoCamera(options);
  const DemoScene scene = MakeDemoScene();
  std::string rgb_list;
  std::string depth_list;
  std::string trajectory;
  for (int frame = 0; frame < options.frame_count; ++frame) {
    progress("making the demo scan", frame, options.frame_count);
    const std::string time = fmt::format("{:.6f}", 1000 + frame / kFrameRate);
    const RigidTransform T_world_camera = DemoCameraPose(frame, options.frame_count);
    WriteFrame(folder, time, RenderDemoFrame(scene, camera, T_world_camera, frame));
    rgb_list += fmt::format("{0} rgb/{0}.jpg\n", time);
    depth_list += fmt::format("{0} depth/{0}.png\n", time);
    trajectory += TrajectoryLine(time, T_world_camera);
  }
  WriteText(folder / "rgb.txt", rgb_list);
  WriteText(folder / "depth.txt", depth_list);
  WriteText(folder / "trajectory.txt", trajectory);
  WriteText(folder / "intrinsics.json", IntrinsicsJson(camera));
  progress("making the demo scan", options.frame_count, options.frame_count);
}

}  // namespace curvefusion
