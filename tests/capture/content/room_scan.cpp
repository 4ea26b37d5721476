#include "tests/capture/content/room_scan.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "tests/capture/sequence_fixture.h"

namespace curvefusion {

namespace {

constexpr PinholeCamera kCamera = {80, 60, 75, 75, 39.5, 29.5};
constexpr double kDepthScale = 5000;

// A box seen from outside, or (the room) from inside; z down the view of the first frame.
struct Box {
  Eigen::AlignedBox3d bounds;
  int shade;
};

const std::array<Box, 4>& Boxes() {
  static const std::array<Box, 4> boxes = {{{{Vec3(-1.4, -1.1, -1), Vec3(1.5, 0.6, 1.7)}, 200},
                                            {{Vec3(-0.5, 0.1, 0.9), Vec3(-0.1, 0.6, 1.3)}, 120},
                                            {{Vec3(0.2, -0.2, 1.1), Vec3(0.5, 0.6, 1.4)}, 160},
                                            {{Vec3(-0.2, 0.35, 0.7), Vec3(0.25, 0.6, 0.85)}, 80}}};
  return boxes;
}

struct Hit {
  double distance = std::numeric_limits<double>::infinity();  // along the ray's direction
  int shade = 0;
};

// Slab test: the far side of the room (index 0), the near side of the others.
void Intersect(const Box& box, bool is_room, const Vec3& origin, const Vec3& direction, Hit& hit) {
  const Eigen::Array3d a = (box.bounds.min() - origin).array() / direction.array();
  const Eigen::Array3d b = (box.bounds.max() - origin).array() / direction.array();
  const double enter = a.min(b).maxCoeff();
  const double leave = a.max(b).minCoeff();
  if (leave < enter || leave <= 0) return;
  const double distance = is_room ? leave : enter;
  if (distance <= 0 || distance >= hit.distance) return;
  const Vec3 point = origin + distance * direction;
  // Chequers of 90 mm; the offset keeps faces off the edges of chequers.
  const Eigen::Array3i cell = ((point.array() + 10.013) / 0.09).floor().cast<int>();
  hit = {distance, cell.sum() % 2 == 0 ? box.shade : box.shade / 3};
}

Hit CastRay(const Vec3& origin, const Vec3& direction) {
  Hit hit;
  for (size_t i = 0; i < Boxes().size(); ++i) {
    Intersect(Boxes()[i], i == 0, origin, direction, hit);
  }
  return hit;
}

// Sums of sines without a common period: a hand's drift, sway and tremor.
RigidTransform HandPose(int frame, double sway) {
  const double t = frame / kRoomFrameRate;
  const auto wave = [t](double hertz, double phase) {
    return std::sin(2 * M_PI * hertz * t + phase);
  };
  const Vec3 shift(0.15 * wave(0.31, 0.2) + 0.006 * wave(2.9, 1), 0.06 * wave(0.47, 1.1),
                   0.08 * wave(0.23, 2) + 0.004 * wave(3.7, 0.4));
  const double yaw = 0.10 * wave(0.37, 0.9) + 0.012 * wave(3.1, 2.2);
  const double pitch = 0.07 * wave(0.53, 0.1) + 0.010 * wave(2.3, 0.7);
  const double roll = 0.05 * wave(0.41, 1.7);
  RigidTransform pose = RigidTransform::Identity();
  pose.translate(sway * shift);
  pose.rotate(Eigen::AngleAxisd(sway * yaw, Vec3::UnitY()) *
              Eigen::AngleAxisd(sway * pitch, Vec3::UnitX()) *
              Eigen::AngleAxisd(sway * roll, Vec3::UnitZ()));
  // A world of its own, as trackers have: neither its origin nor its axes are the camera's.
  RigidTransform T_world_room = RigidTransform::Identity();
  T_world_room.translate(Vec3(0.4, -0.3, 0.6));
  T_world_room.rotate(Eigen::AngleAxisd(0.7, Vec3(1, 2, -0.5).normalized()));
  return T_world_room * pose;
}

using Caster = std::function<Hit(const Vec3& origin, const Vec3& direction)>;

void Render(const Caster& cast, const RigidTransform& T_room_camera, Image<uint16_t>& depth,
            Image<uint8_t>& grey) {
  depth = Image<uint16_t>(kCamera.width, kCamera.height);
  grey = Image<uint8_t>(kCamera.width, kCamera.height);
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const Vec3 ray = kCamera.Unproject(u, v, 1);  // so that the distance is the depth
      const Hit hit = cast(T_room_camera.translation(), T_room_camera.linear() * ray);
      depth(u, v) = static_cast<uint16_t>(std::lround(hit.distance * kDepthScale));
      grey(u, v) = static_cast<uint8_t>(hit.shade);
    }
  }
}

RoomScan MakeScan(const Caster& cast, double sway) {
  RoomScan scan;
  scan.sequence.format = "per-frame poses";
  scan.sequence.folder = "room";
  scan.sequence.depth_camera = scan.sequence.color_camera = kCamera;
  scan.sequence.depth_scale = kDepthScale;
  const RigidTransform T_world_room = HandPose(0, 0);
  for (int i = 0; i < kRoomFrames; ++i) {
    SequenceFrame frame;
    frame.name = fmt::format("{:06}", i);
    frame.timestamp = 100 + i / kRoomFrameRate;
    frame.T_world_camera = HandPose(i, sway);
    scan.sequence.frames.push_back(frame);
  }
  scan.thumbnails = EmptyThumbnails(scan.sequence);
  for (int i = 0; i < kRoomFrames; ++i) {
    const auto k = static_cast<size_t>(i);
    Render(cast, T_world_room.inverse() * scan.sequence.frames[k].T_world_camera,
           scan.thumbnails.depth[k], scan.thumbnails.grey[k]);
  }
  return scan;
}

}  // namespace

RoomScan MakeRoomScan(double sway) { return MakeScan(CastRay, sway); }

RoomScan MakeWallScan() {
  const auto wall = [](const Vec3& origin, const Vec3& direction) {
    return Hit{(1.2 - origin.z()) / direction.z(), 128};
  };
  RoomScan scan = MakeScan(wall, 0);
  for (int i = 0; i < kRoomFrames; ++i) {
    // Along the wall: right poses, which no depth can confirm.
    scan.sequence.frames[static_cast<size_t>(i)].T_world_camera.translate(Vec3(0.005 * i, 0, 0));
  }
  return scan;
}

void WriteRoomScan(const RoomScan& scan, const std::filesystem::path& folder) {
  Trajectory trajectory;
  std::string pairs;
  std::filesystem::create_directories(folder / "rgb");
  std::filesystem::create_directories(folder / "depth");
  for (int i = 0; i < kRoomFrames; ++i) {
    const auto k = static_cast<size_t>(i);
    Image<uint16_t> depth = scan.thumbnails.depth[k];
    Image<uint8_t> grey = scan.thumbnails.grey[k];
    const SequenceFrame& frame = scan.sequence.frames[k];
    cv::imwrite((folder / fmt::format("depth/{}.png", i)).string(),
                cv::Mat(depth.height(), depth.width(), CV_16UC1, depth.data()));
    cv::imwrite((folder / fmt::format("rgb/{}.png", i)).string(),
                cv::Mat(grey.height(), grey.width(), CV_8UC1, grey.data()));
    pairs += fmt::format("{0:.6f} rgb/{1}.png {0:.6f} depth/{1}.png\n", frame.timestamp, i);
    trajectory.push_back({frame.timestamp, frame.T_world_camera});
  }
  WriteText(folder / "associations.txt", pairs);
  WriteText(folder / "intrinsics.json",
            R"({"width":80,"height":60,"fx":75,"fy":75,"cx":39.5,"cy":29.5,"depth_scale":5000})");
  WriteTumTrajectory(folder / "trajectory.txt", trajectory);
}

}  // namespace curvefusion
