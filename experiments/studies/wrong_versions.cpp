#include "experiments/studies/wrong_versions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "capture/content/colour_findings.h"
#include "capture/content/pose_hypotheses.h"
#include "capture/content/repair.h"
#include "capture/detect_format.h"
#include "capture/sequence.h"
#include "capture/trajectory.h"
#include "kernel/atomic_file.h"
#include "kernel/error.h"
#include "kernel/json_input.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

// What a mistake does to a sequence that is right, and to what `check` should find.
using ScanChange = std::function<void(SequenceCorrection&, Mistake&)>;
// The same to a sequence that has been written.
using FileChange = std::function<void(const fs::path& folder, Mistake&)>;

struct NamedMistake {
  WrongVersion version;
  ScanChange make;
  FileChange change_files = {};
};

ScanChange ChangePoses(const std::function<RigidTransform(const RigidTransform&)>& change) {
  return [change](SequenceCorrection& scan, Mistake&) {
    for (SequenceFrame& frame : scan.sequence.frames) {
      frame.T_world_camera = change(frame.T_world_camera);
    }
  };
}

// As a reader takes (qw qx qy qz) for (qx qy qz qw).
RigidTransform ReadWithWFirst(const RigidTransform& pose) {
  const Eigen::Quaterniond q(pose.linear());
  RigidTransform changed = pose;
  changed.linear() = Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()).toRotationMatrix();
  return changed;
}

RigidTransform ToOpenGl(const RigidTransform& pose) {
  RigidTransform changed = pose;
  changed.linear() = pose.linear() * Vec3(1, -1, -1).asDiagonal();
  return changed;
}

ScanChange ScaleTranslations(double factor) {
  return [factor](SequenceCorrection& scan, Mistake& expected) {
    for (SequenceFrame& frame : scan.sequence.frames) frame.T_world_camera.translation() *= factor;
    expected.amount = {1 / factor, "factor"};
  };
}

ScanChange ScaleDepthUnit(double factor) {
  return [factor](SequenceCorrection& scan, Mistake& expected) {
    expected.amount = {scan.sequence.depth_scale, "units per metre"};
    scan.sequence.depth_scale *= factor;
  };
}

// The layout with one pose a frame, in which nothing but the number says what belongs together.
void UseFrameNumbers(Sequence& sequence) {
  sequence.format = "per-frame poses";
  for (size_t i = 0; i < sequence.frames.size(); ++i) {
    sequence.frames[i].name = fmt::format("{:06}", i);
  }
}

// Frame i gets the pose of the frame order(i); those without one go.
ScanChange OrderPoses(const std::function<int(int frame, int count)>& order) {
  return [order](SequenceCorrection& scan, Mistake&) {
    UseFrameNumbers(scan.sequence);
    const std::vector<SequenceFrame> right = scan.sequence.frames;
    const int count = static_cast<int>(right.size());
    scan.sequence.frames.clear();
    for (int i = 0; i < count; ++i) {
      const int other = order(i, count);
      if (other < 0 || other >= count) continue;
      scan.sequence.frames.push_back(right[static_cast<size_t>(i)]);
      scan.sequence.frames.back().T_world_camera = right[static_cast<size_t>(other)].T_world_camera;
    }
  };
}

// Poses late by so many frames: frame i stands with the pose of frame i - frames.
ScanChange DelayPoses(int frames) {
  const ScanChange reorder = OrderPoses([frames](int i, int) { return i - frames; });
  return [frames, reorder](SequenceCorrection& scan, Mistake& expected) {
    reorder(scan, expected);
    expected.amount = {static_cast<double>(frames), "frames"};
  };
}

ScanChange DelayColor(int frames) {
  return [frames](SequenceCorrection& scan, Mistake& expected) {
    expected.amount = {static_cast<double>(frames), "frames"};
    const std::vector<SequenceFrame> right = scan.sequence.frames;
    scan.sequence.frames.clear();
    for (int i = 0; i < static_cast<int>(right.size()); ++i) {
      const int other = i - frames;
      if (other < 0 || other >= static_cast<int>(right.size())) continue;
      scan.sequence.frames.push_back(right[static_cast<size_t>(i)]);
      scan.sequence.frames.back().color_path = right[static_cast<size_t>(other)].color_path;
      scan.sequence.frames.back().color_part = right[static_cast<size_t>(other)].color_part;
    }
  };
}

// The frames from a place on (or only one) stand 40 mm and 2 degrees off.
ScanChange Jump(bool comes_back) {
  return [comes_back](SequenceCorrection& scan, Mistake& expected) {
    std::vector<SequenceFrame>& frames = scan.sequence.frames;
    const size_t first = frames.size() * 2 / 5;
    const size_t end = comes_back ? first + 1 : frames.size();
    for (size_t i = first; i < end; ++i) {
      frames[i].T_world_camera.translation() += Vec3(0.03, 0.02, -0.02);
      frames[i].T_world_camera.rotate(Eigen::AngleAxisd(2 * M_PI / 180, Vec3::UnitY()));
    }
    expected.frames = {{frames[comes_back ? first : first - 1].name, frames[first].name}};
  };
}

// A tracker that goes astray for a quarter of the scan and comes back: by up to 12 degrees and 50
// mm.
void LoseTracking(SequenceCorrection& scan, Mistake& expected) {
  std::vector<SequenceFrame>& frames = scan.sequence.frames;
  const size_t first = frames.size() * 2 / 5;
  const size_t count = frames.size() / 4;
  for (size_t i = 0; i < count; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double astray = std::pow(std::sin(M_PI * share), 2);
    RigidTransform& pose = frames[first + i].T_world_camera;
    pose.translate(Vec3(0.05 * astray, 0, 0));
    pose.rotate(Eigen::AngleAxisd(12 * M_PI / 180 * astray, Vec3::UnitX()));
  }
  expected.frames = {{frames[first].name, frames[first + count - 1].name}};
}

void DoNothing(SequenceCorrection&, Mistake&) {}

FileChange MoveClock(double seconds) {
  return [seconds](const fs::path& folder, Mistake& expected) {
    const fs::path path = folder / "trajectory.txt";
    Trajectory trajectory = ReadTumTrajectory(path, [](const CheckFinding&) {});
    for (StampedPose& pose : trajectory) pose.timestamp += seconds;
    WriteTumTrajectory(path, trajectory);
    expected.amount = {seconds, "s"};
  };
}

// Writes another colour camera into intrinsics.json: by factors and parts of the image's width.
FileChange ChangeColourCamera(double focal_factor, double right, double down, double baseline) {
  return [=](const fs::path& folder, Mistake&) {
    const Sequence scan = ReadQuietly(folder);
    PinholeCamera camera = scan.color_camera;
    camera.fx *= focal_factor;
    camera.fy *= focal_factor;
    camera.cx += right * camera.width;
    camera.cy += down * camera.width;
    RigidTransform T_color_depth = scan.T_color_depth;
    T_color_depth.translation().x() += baseline;
    const fs::path path = folder / "intrinsics.json";
    nlohmann::ordered_json json = ParseJson(ReadFile(path), path.string());
    json.update(nlohmann::ordered_json::parse("{" + ColourCameraJson(camera, T_color_depth) + "}"));
    WriteStreamAtomically(path, [&](std::ostream& stream) { stream << json.dump(1) << "\n"; });
  };
}

std::vector<NamedMistake> Mistakes() {
  const auto inverse = [](const RigidTransform& pose) { return pose.inverse(); };
  return {{{"inverted", "poses-inverted"}, ChangePoses(inverse)},
          {{"w_first", "quaternion-w-first"}, ChangePoses(ReadWithWFirst)},
          {{"opengl", "opengl-axes"}, ChangePoses(ToOpenGl)},
          {{"translations_mm", "translation-scale"}, ScaleTranslations(1000)},
          {{"translations_cm", "translation-scale"}, ScaleTranslations(100)},
          {{"translations_feet", "translation-scale"}, ScaleTranslations(1 / 0.3048)},
          {{"translations_other", "translation-scale"}, ScaleTranslations(0.37)},
          {{"translations_fifth", "translation-scale"}, ScaleTranslations(0.2)},
          {{"depth_unit_x2", "depth-scale"}, ScaleDepthUnit(2)},
          {{"depth_unit_half", "depth-scale"}, ScaleDepthUnit(0.5)},
          {{"depth_unit_x5", "depth-scale"}, ScaleDepthUnit(5)},
          {{"depth_unit_fifth", "depth-scale"}, ScaleDepthUnit(0.2)},
          {{"depth_unit_x10", "depth-scale"}, ScaleDepthUnit(10)},
          {{"depth_unit_tenth", "depth-scale"}, ScaleDepthUnit(0.1)},
          {{"depth_unit_x1000", "depth-scale"}, ScaleDepthUnit(1000)},
          {{"depth_unit_thousandth", "depth-scale"}, ScaleDepthUnit(0.001)},
          {{"bytes_swapped", "depth-bytes-swapped"},
           [](SequenceCorrection& scan, Mistake&) { scan.swap_bytes = true; }},
          {{"poses_late_2", "poses-late"}, DelayPoses(2)},
          {{"poses_early_5", "poses-late"}, DelayPoses(-5)},
          {{"poses_late_7", "poses-late"}, DelayPoses(7)},
          {{"poses_late_10", "poses-late"}, DelayPoses(10)},
          {{"clock_late_0.1s", "clock-offset"}, DoNothing, MoveClock(0.1)},
          {{"clock_early_0.25s", "clock-offset"}, DoNothing, MoveClock(-0.25)},
          {{"clock_other_zone", "clock-offset"}, DoNothing, MoveClock(3600.4)},
          {{"color_late_3", "colour-late"}, DelayColor(3)},
          {{"color_early_7", "colour-late"}, DelayColor(-7)},
          {{"color_late_10", "colour-late"}, DelayColor(10)},
          {{"poses_reversed", "frame-order"},
           OrderPoses([](int i, int count) { return count - 1 - i; })},
          {{"poses_in_text_order", "frame-order"}, OrderPoses([](int i, int count) {
             return OrderAsText(count, 0)[static_cast<size_t>(i)];
           })},
          {{"images_in_text_order", "frame-order"}, OrderPoses([](int i, int count) {
             const std::vector<int> order = OrderAsText(count, 1);
             return static_cast<int>(std::find(order.begin(), order.end(), i) - order.begin());
           })},
          {{"one_pose_off", "pose-jump"}, Jump(true)},
          {{"jump", "pose-jump"}, Jump(false)},
          {{"tracking_lost", "bad-stretch"}, LoseTracking},
          // As if images that were warped onto depth were those of the camera beside it.
          {{"colour_camera_of_raw_images", "colour-misregistered"},
           DoNothing,
           ChangeColourCamera(0.92, 0, 0, -0.025)},
          {{"colour_centre_off", "colour-misregistered"},
           DoNothing,
           ChangeColourCamera(1, 0.03, -0.015, 0)}};
}

}  // namespace

std::vector<WrongVersion> WrongVersions() {
  std::vector<WrongVersion> versions;
  for (const NamedMistake& mistake : Mistakes()) versions.push_back(mistake.version);
  return versions;
}

Mistake WriteWrongVersion(const fs::path& scan, const std::string& name, const fs::path& folder) {
  for (const NamedMistake& mistake : Mistakes()) {
    if (mistake.version.name != name) continue;
    SequenceCorrection written{OpenSequence(scan), false, {}};
    Mistake expected{mistake.version.cause};
    mistake.make(written, expected);
    WriteRepairedSequence(written, folder);
    if (mistake.change_files) mistake.change_files(folder, expected);
    return expected;
  }
  throw Error(ErrorKind::kUsage, "there is no wrong version " + name);
}

}  // namespace curvefusion
