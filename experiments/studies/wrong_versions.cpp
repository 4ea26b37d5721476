#include "experiments/studies/wrong_versions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "capture/content/pose_hypotheses.h"
#include "capture/content/repair.h"
#include "capture/sequence.h"
#include "capture/trajectory.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

// What a mistake does to a sequence that is right.
using Mistake = std::function<void(SequenceCorrection&)>;

struct NamedMistake {
  WrongVersion version;
  Mistake make;
  double clock = 0;  // seconds added to the stamps of the trajectory
};

Mistake ChangePoses(const std::function<RigidTransform(const RigidTransform&)>& change) {
  return [change](SequenceCorrection& scan) {
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

Mistake ScaleTranslations(double factor) {
  return ChangePoses([factor](const RigidTransform& pose) {
    RigidTransform changed = pose;
    changed.translation() *= factor;
    return changed;
  });
}

Mistake ScaleDepthUnit(double factor) {
  return [factor](SequenceCorrection& scan) { scan.sequence.depth_scale *= factor; };
}

// The layout with one pose a frame, in which nothing but the number says what belongs together.
void UseFrameNumbers(Sequence& sequence) {
  sequence.format = "per-frame poses";
  for (size_t i = 0; i < sequence.frames.size(); ++i) {
    sequence.frames[i].name = fmt::format("{:06}", i);
  }
}

// Frame i gets the pose of the frame order(i); those without one go.
Mistake OrderPoses(const std::function<int(int frame, int count)>& order) {
  return [order](SequenceCorrection& scan) {
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
Mistake DelayPoses(int frames) {
  return OrderPoses([frames](int i, int) { return i - frames; });
}

Mistake DelayColor(int frames) {
  return [frames](SequenceCorrection& scan) {
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
Mistake Jump(bool comes_back) {
  return [comes_back](SequenceCorrection& scan) {
    const size_t first = scan.sequence.frames.size() * 2 / 5;
    const size_t end = comes_back ? first + 1 : scan.sequence.frames.size();
    for (size_t i = first; i < end; ++i) {
      RigidTransform& pose = scan.sequence.frames[i].T_world_camera;
      pose.translation() += Vec3(0.03, 0.02, -0.02);
      pose.rotate(Eigen::AngleAxisd(2 * M_PI / 180, Vec3::UnitY()));
    }
  };
}

std::vector<NamedMistake> Mistakes() {
  const auto inverse = [](const RigidTransform& pose) { return pose.inverse(); };
  const Mistake nothing = [](SequenceCorrection&) {};
  return {{{"inverted", "poses-inverted"}, ChangePoses(inverse)},
          {{"w_first", "quaternion-w-first"}, ChangePoses(ReadWithWFirst)},
          {{"opengl", "opengl-axes"}, ChangePoses(ToOpenGl)},
          {{"translations_mm", "translation-scale"}, ScaleTranslations(1000)},
          {{"translations_cm", "translation-scale"}, ScaleTranslations(100)},
          {{"translations_feet", "translation-scale"}, ScaleTranslations(1 / 0.3048)},
          {{"translations_other", "translation-scale"}, ScaleTranslations(0.37)},
          {{"depth_unit_x2", "depth-scale"}, ScaleDepthUnit(2)},
          {{"depth_unit_half", "depth-scale"}, ScaleDepthUnit(0.5)},
          {{"depth_unit_x5", "depth-scale"}, ScaleDepthUnit(5)},
          {{"depth_unit_fifth", "depth-scale"}, ScaleDepthUnit(0.2)},
          {{"depth_unit_x10", "depth-scale"}, ScaleDepthUnit(10)},
          {{"depth_unit_tenth", "depth-scale"}, ScaleDepthUnit(0.1)},
          {{"depth_unit_x1000", "depth-scale"}, ScaleDepthUnit(1000)},
          {{"depth_unit_thousandth", "depth-scale"}, ScaleDepthUnit(0.001)},
          {{"bytes_swapped", "depth-bytes-swapped"},
           [](SequenceCorrection& scan) { scan.swap_bytes = true; }},
          {{"poses_late_2", "poses-late"}, DelayPoses(2)},
          {{"poses_early_5", "poses-late"}, DelayPoses(-5)},
          {{"poses_late_10", "poses-late"}, DelayPoses(10)},
          {{"clock_late_0.1s", "clock-offset"}, nothing, 0.1},
          {{"clock_early_0.25s", "clock-offset"}, nothing, -0.25},
          {{"clock_other_zone", "clock-offset"}, nothing, 3600.4},
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
          {{"jump", "pose-jump"}, Jump(false)}};
}

void MoveClock(const fs::path& folder, double seconds) {
  Trajectory trajectory = ReadTumTrajectory(folder / "trajectory.txt", [](const CheckFinding&) {});
  for (StampedPose& pose : trajectory) pose.timestamp += seconds;
  WriteTumTrajectory(folder / "trajectory.txt", trajectory);
}

}  // namespace

std::vector<WrongVersion> WrongVersions() {
  std::vector<WrongVersion> versions;
  for (const NamedMistake& mistake : Mistakes()) versions.push_back(mistake.version);
  return versions;
}

void WriteWrongVersion(const fs::path& scan, const std::string& name, const fs::path& folder) {
  SequenceCorrection written{OpenSequence(scan), false, {}};
  if (name.empty()) return WriteRepairedSequence(written, folder);
  for (const NamedMistake& mistake : Mistakes()) {
    if (mistake.version.name != name) continue;
    mistake.make(written);
    WriteRepairedSequence(written, folder);
    if (mistake.clock != 0) MoveClock(folder, mistake.clock);
    return;
  }
  throw Error(ErrorKind::kUsage, "there is no wrong version " + name);
}

}  // namespace curvefusion
