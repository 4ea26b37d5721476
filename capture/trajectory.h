#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "capture/finding.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// Images and poses belong together when their stamps differ by no more (DESIGN "Formats",
/// seconds).
inline constexpr double kAssociationTolerance = 0.020;

/// Where a camera was at a time.
struct StampedPose {
  double timestamp = 0;  ///< seconds
  RigidTransform T_world_camera = RigidTransform::Identity();
};

/// Poses in ascending order of their stamps, no stamp twice.
using Trajectory = std::vector<StampedPose>;

/// Reads a trajectory in TUM format: `t tx ty tz qx qy qz qw` per line, camera in world, metres.
/// Reports unreadable lines, poses that are not finite, quaternions whose length is off by more
/// than 1 %, unsorted stamps (which are put in order) and duplicate stamps (the first one stays).
/// Throws Error(kBadInput) where the file cannot be read.
Trajectory ReadTumTrajectory(const std::filesystem::path& path, const FindingHandler& on_finding);

/// Writes a trajectory in TUM format, one line a pose. Throws Error(kResource) where the file
/// cannot be written.
void WriteTumTrajectory(const std::filesystem::path& path, const Trajectory& trajectory);

/// Reads a 4x4 matrix, row by row, that maps camera to world. Returns nothing, and reports, where
/// the file does not hold one or it is not rigid.
std::optional<RigidTransform> ReadPoseMatrix(const std::filesystem::path& path,
                                             const FindingHandler& on_finding);

/// The rigid motion of a 4x4 matrix, its rotation made orthonormal. Where the matrix is not finite
/// or not rigid (|R'R - I| > 1e-3 in the largest entry, or det R < 0), reports it under the name
/// `what` and returns nothing.
std::optional<RigidTransform> RigidFromMatrix(const Eigen::Matrix4d& matrix,
                                              const std::string& what,
                                              const FindingHandler& on_finding);

/// The rigid motion of a unit quaternion and a translation. Where a value is not finite or the
/// length of the quaternion is off by more than 1 %, reports it under the name `what` and returns
/// nothing.
std::optional<RigidTransform> RigidFromQuaternion(const Eigen::Quaterniond& rotation,
                                                  const Vec3& translation, const std::string& what,
                                                  const FindingHandler& on_finding);

/// The pose with the stamp nearest to `timestamp`, or null where none is within `tolerance`
/// (seconds).
const StampedPose* NearestPose(const Trajectory& trajectory, double timestamp,
                               double tolerance = kAssociationTolerance);

/// The pose at a time, between those before and after it; none outside the trajectory and where
/// these are more than `max_gap` seconds apart.
std::optional<RigidTransform> PoseAt(const Trajectory& trajectory, double time, double max_gap);

}  // namespace curvefusion
