#include "capture/trajectory.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>

#include "capture/stamps.h"
#include "capture/text_lines.h"
#include "kernel/atomic_file.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

constexpr double kMaxRotationDefect = 1e-3;
constexpr double kMaxQuaternionDefect = 1e-2;  // trajectories are written with as few as 3 digits

void ReportError(const FindingHandler& on_finding, const std::string& message) {
  on_finding({Severity::kError, message});
}

// The numbers of a line, or nothing (and a report) where it does not hold `count` numbers.
template <size_t count>
std::optional<std::array<double, count>> ParseNumbers(const TextLine& line,
                                                      const std::string& where,
                                                      const FindingHandler& on_finding) {
  std::array<double, count> numbers;
  if (line.fields.size() < count) {
    ReportError(on_finding, fmt::format("{}: {} numbers are needed, the line has {}", where, count,
                                        line.fields.size()));
    return std::nullopt;
  }
  for (size_t i = 0; i < count; ++i) {
    const auto number = ParseNumber(line.fields[i]);
    if (!number) {
      ReportError(on_finding, fmt::format("{}: '{}' is not a number", where, line.fields[i]));
      return std::nullopt;
    }
    numbers[i] = *number;
  }
  return numbers;
}

std::optional<StampedPose> ParseTumPose(const TextLine& line, const std::string& where,
                                        const FindingHandler& on_finding) {
  const auto numbers = ParseNumbers<8>(line, where, on_finding);
  if (!numbers) return std::nullopt;
  const auto& [t, x, y, z, qx, qy, qz, qw] = *numbers;
  for (const double value : *numbers) {
    if (std::isfinite(value)) continue;
    ReportError(on_finding, fmt::format("{}: the pose at {} holds {}; remove the line to leave out "
                                        "this frame",
                                        where, line.fields[0], value));
    return std::nullopt;
  }
  const Eigen::Quaterniond rotation(qw, qx, qy, qz);
  if (std::abs(rotation.norm() - 1) > kMaxQuaternionDefect) {
    ReportError(on_finding,
                fmt::format("{}: the quaternion of the pose at {} has length {:.4g}, not 1; the "
                            "columns must be t tx ty tz qx qy qz qw",
                            where, line.fields[0], rotation.norm()));
    return std::nullopt;
  }
  StampedPose pose;
  pose.timestamp = t;
  pose.T_world_camera.linear() = rotation.normalized().toRotationMatrix();
  pose.T_world_camera.translation() = Vec3(x, y, z);
  return pose;
}

}  // namespace

Trajectory ReadTumTrajectory(const std::filesystem::path& path, const FindingHandler& on_finding) {
  Trajectory trajectory;
  for (const TextLine& line : ReadTextLines(path)) {
    const std::string where = fmt::format("{}:{}", path.string(), line.number);
    if (const auto pose = ParseTumPose(line, where, on_finding)) trajectory.push_back(*pose);
  }
  SortByStamp(
      path.string(), [](const StampedPose& pose) { return pose.timestamp; }, on_finding,
      trajectory);
  return trajectory;
}

void WriteTumTrajectory(const std::filesystem::path& path, const Trajectory& trajectory) {
  WriteStreamAtomically(path, [&](std::ostream& stream) {
    for (const StampedPose& pose : trajectory) {
      const Vec3 t = pose.T_world_camera.translation();
      const Eigen::Quaterniond q(pose.T_world_camera.rotation());
      stream << fmt::format("{:.6f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n",
                            pose.timestamp, t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
    }
  });
}

std::optional<RigidTransform> ReadPoseMatrix(const std::filesystem::path& path,
                                             const FindingHandler& on_finding) {
  Eigen::Matrix4d matrix;
  int row = 0;
  for (const TextLine& line : ReadTextLines(path)) {
    if (row == 4) break;
    const auto numbers =
        ParseNumbers<4>(line, fmt::format("{}:{}", path.string(), line.number), on_finding);
    if (!numbers) return std::nullopt;
    matrix.row(row++) = Eigen::Map<const Eigen::RowVector4d>(numbers->data());
  }
  if (row < 4) {
    ReportError(on_finding, fmt::format("{}: has {} rows, a 4x4 camera-to-world matrix is needed; "
                                        "remove the file to leave out this frame",
                                        path.string(), row));
    return std::nullopt;
  }
  return RigidFromMatrix(matrix, path.string(), on_finding);
}

std::optional<RigidTransform> RigidFromQuaternion(const Eigen::Quaterniond& rotation,
                                                  const Vec3& translation, const std::string& what,
                                                  const FindingHandler& on_finding) {
  if (!translation.allFinite() ||
      !(std::abs(rotation.norm() - 1) <= kMaxQuaternionDefect)) {  // also where it is not finite
    ReportError(
        on_finding,
        fmt::format("{}: the quaternion has length {:.4g}, not 1, or the translation ({}, {}, "
                    "{}) is not finite",
                    what, rotation.norm(), translation.x(), translation.y(), translation.z()));
    return std::nullopt;
  }
  RigidTransform pose = RigidTransform::Identity();
  pose.linear() = rotation.normalized().toRotationMatrix();
  pose.translation() = translation;
  return pose;
}

std::optional<RigidTransform> RigidFromMatrix(const Eigen::Matrix4d& matrix,
                                              const std::string& what,
                                              const FindingHandler& on_finding) {
  if (!matrix.allFinite()) {
    ReportError(
        on_finding,
        fmt::format("{}: the pose holds NaN or infinity; remove it to leave out this frame", what));
    return std::nullopt;
  }
  const Mat3 rotation = matrix.topLeftCorner<3, 3>();
  const double defect = (rotation.transpose() * rotation - Mat3::Identity())
                            .cwiseAbs()
                            .maxCoeff<Eigen::PropagateNaN>();  // of entries that overflow
  if (!(defect <= kMaxRotationDefect) || rotation.determinant() < 0 ||
      !matrix.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), kMaxRotationDefect)) {
    ReportError(on_finding,
                fmt::format("{}: the pose is not rigid: |R'R - I| = {:.3g} (limit {}), det R = "
                            "{:.3g} (must be 1), last row {} {} {} {} (must be 0 0 0 1); poses are "
                            "4x4 camera-to-world matrices without scale or mirror",
                            what, defect, kMaxRotationDefect, rotation.determinant(), matrix(3, 0),
                            matrix(3, 1), matrix(3, 2), matrix(3, 3)));
    return std::nullopt;
  }
  const Eigen::JacobiSVD<Mat3> svd(rotation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  RigidTransform pose = RigidTransform::Identity();
  pose.linear() = svd.matrixU() * svd.matrixV().transpose();
  pose.translation() = matrix.topRightCorner<3, 1>();
  return pose;
}

const StampedPose* NearestPose(const Trajectory& trajectory, double timestamp, double tolerance) {
  auto nearest = std::lower_bound(
      trajectory.begin(), trajectory.end(), timestamp,
      [](const StampedPose& pose, double stamp) { return pose.timestamp < stamp; });
  if (nearest == trajectory.end() ||
      (nearest != trajectory.begin() &&
       timestamp - std::prev(nearest)->timestamp <= nearest->timestamp - timestamp)) {
    if (nearest == trajectory.begin()) return nullptr;
    --nearest;
  }
  return std::abs(nearest->timestamp - timestamp) <= tolerance ? &*nearest : nullptr;
}

std::optional<RigidTransform> PoseAt(const Trajectory& trajectory, double time, double max_gap) {
  const auto after = std::lower_bound(
      trajectory.begin(), trajectory.end(), time,
      [](const StampedPose& pose, double stamp) { return pose.timestamp < stamp; });
  if (after == trajectory.end()) return std::nullopt;
  if (after->timestamp == time) return after->T_world_camera;
  if (after == trajectory.begin()) return std::nullopt;
  const StampedPose& before = *std::prev(after);
  const double gap = after->timestamp - before.timestamp;
  if (gap > max_gap) return std::nullopt;
  const double share = (time - before.timestamp) / gap;
  const Eigen::Quaterniond first(before.T_world_camera.linear());
  const Eigen::Quaterniond second(after->T_world_camera.linear());
  RigidTransform pose = RigidTransform::Identity();
  pose.linear() = first.slerp(share, second).toRotationMatrix();
  pose.translation() = (1 - share) * before.T_world_camera.translation() +
                       share * after->T_world_camera.translation();
  return pose;
}

}  // namespace curvefusion
