#include "capture/content/pose_hypotheses.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr double kMaxTimeBetween = 0.2;  // seconds; over more a hand's motion is not straight
constexpr double kMaxSteps = 1.5;        // of trajectories that are slower than that

using PoseChange = std::function<RigidTransform(const RigidTransform&)>;

FramePoses Changed(const FramePoses& poses, const PoseChange& change) {
  FramePoses changed(poses.size());
  for (size_t i = 0; i < poses.size(); ++i) {
    if (poses[i]) changed[i] = change(*poses[i]);
  }
  return changed;
}

// q and -q give the same rotation here, too: the sign of a quaternion from a matrix does not
// matter.
RigidTransform WithWFirst(const RigidTransform& pose) {
  const Eigen::Quaterniond read(pose.linear());
  RigidTransform changed = pose;
  changed.linear() = Eigen::Quaterniond(read.x(), read.y(), read.z(), read.w()).toRotationMatrix();
  return changed;
}

RigidTransform FromOpenGl(const RigidTransform& pose) {
  RigidTransform changed = pose;
  changed.linear() = pose.linear() * Vec3(1, -1, -1).asDiagonal();
  return changed;
}

// The i-th frame gets the pose of place order[i].
FramePoses Reordered(const FramePoses& poses, const std::vector<int>& order) {
  FramePoses reordered(poses.size());
  for (size_t i = 0; i < poses.size(); ++i) reordered[i] = poses[static_cast<size_t>(order[i])];
  return reordered;
}

std::vector<int> Inverse(const std::vector<int>& order) {
  std::vector<int> inverse(order.size());
  for (size_t i = 0; i < order.size(); ++i) {
    inverse[static_cast<size_t>(order[i])] = static_cast<int>(i);
  }
  return inverse;
}

double MedianStep(const Trajectory& trajectory) {
  std::vector<double> steps;
  for (size_t i = 1; i < trajectory.size(); ++i) {
    steps.push_back(trajectory[i].timestamp - trajectory[i - 1].timestamp);
  }
  return steps.empty() ? 0 : Median(std::move(steps));
}

}  // namespace

FramePoses GivenPoses(const Sequence& sequence) {
  FramePoses poses;
  for (const SequenceFrame& frame : sequence.frames) poses.emplace_back(frame.T_world_camera);
  return poses;
}

FramePoses StandingPoses(size_t frame_count) {
  return FramePoses(frame_count, RigidTransform::Identity());
}

std::vector<PoseHypothesis> ConventionHypotheses(const FramePoses& poses) {
  const auto inverse = [](const RigidTransform& pose) { return pose.inverse(); };
  return {{"poses-inverted", "the poses map world to camera, not camera to world",
           Changed(poses, inverse)},
          {"quaternion-w-first", "the quaternions are written with w first (qw qx qy qz)",
           Changed(poses, WithWFirst)},
          {"opengl-axes", "the poses are those of OpenGL's camera, which looks along -z with y up",
           Changed(poses, FromOpenGl)}};
}

std::vector<int> OrderAsText(int count, int first) {
  std::vector<int> order(static_cast<size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [first](int a, int b) {
    return std::to_string(a + first) < std::to_string(b + first);
  });
  return order;
}

std::vector<PoseHypothesis> OrderHypotheses(const FramePoses& poses) {
  const int count = static_cast<int>(poses.size());
  std::vector<int> reverse(poses.size());
  std::iota(reverse.rbegin(), reverse.rend(), 0);
  std::vector<PoseHypothesis> hypotheses = {{"frame-order",
                                             "the poses are in the reverse order of the images",
                                             Reordered(poses, reverse)}};
  for (const int first : {0, 1}) {
    const std::vector<int> order = OrderAsText(count, first);
    hypotheses.push_back({"frame-order",
                          "the images are in the order of their numbers as text (0, 1, 10, 11, "
                          "..., 2), the poses in that of their values",
                          Reordered(poses, order)});
    hypotheses.push_back({"frame-order",
                          "the poses are in the order of their numbers as text (0, 1, 10, 11, "
                          "..., 2), the images in that of their values",
                          Reordered(poses, Inverse(order))});
  }
  return hypotheses;
}

FramePoses ScaledTranslations(const FramePoses& poses, double factor) {
  return Changed(poses, [factor](const RigidTransform& pose) {
    RigidTransform changed = pose;
    changed.translation() *= factor;
    return changed;
  });
}

FramePoses DelayedPoses(const FramePoses& poses, int frames) {
  const auto count = static_cast<int64_t>(poses.size());
  FramePoses delayed(poses.size());
  for (int64_t i = std::max(0, -frames); i < count && i + frames < count; ++i) {
    delayed[static_cast<size_t>(i)] = poses[static_cast<size_t>(i + frames)];
  }
  return delayed;
}

FramePoses PosesAt(const Trajectory& trajectory, const std::vector<double>& times, double offset) {
  const double max_gap = std::max(kMaxTimeBetween, kMaxSteps * MedianStep(trajectory));
  FramePoses poses;
  for (const double time : times) poses.push_back(PoseAt(trajectory, time + offset, max_gap));
  return poses;
}

}  // namespace curvefusion
