#include "experiments/simulation/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/simulation/noise_process.h"
#include "kernel/angle.h"
#include "kernel/rigid_motion.h"

namespace curvefusion {
namespace {

constexpr double kPi = std::numbers::pi;

// The smooth path without the hand, by a parameter that is about the metres travelled sideways.
struct ArcPath {
  ScanTask task;
  double sweep = 0;         // radians to either side
  double sweep_length = 0;  // parameter of one sweep from side to side
  double azimuth_center = 0;
  double phase_elevation = 0;
  double phase_standoff = 0;

  Vec3 Position(double q) const {
    const double azimuth = azimuth_center - sweep * std::cos(kPi * q / sweep_length);
    const double elevation =
        18 * kDegree + 13 * kDegree * std::sin(2 * kPi * q / 0.55 + phase_elevation);
    const Vec3 direction(std::cos(elevation) * std::sin(azimuth),
                         -std::cos(elevation) * std::cos(azimuth), std::sin(elevation));
    const Vec3 half = task.object_bounds.sizes() / 2;
    // To the box's support point in this direction, so that no object comes nearer than intended.
    const double reach = 0.8 * direction.cwiseAbs().dot(half);
    const double distance =
        task.standoff * (1 + std::sin(2 * kPi * q / 0.8 + phase_standoff) / 8) + reach;
    Vec3 position = task.object_bounds.center() + distance * direction;
    position.z() = std::max(position.z(), task.table_height + 0.1);
    return position;
  }

  // Large objects are looked at part by part: the target wanders along what the view leaves out.
  Vec3 Target(double q) const {
    const Vec3 in_view = Vec3::Constant(0.9 * task.view_half_height);
    const Vec3 beyond = (task.object_bounds.sizes() / 2 - in_view).cwiseMax(0);
    return task.object_bounds.center() + Vec3(beyond.x() * -std::cos(kPi * q / sweep_length),
                                              beyond.y() * 0.5 * std::sin(2 * kPi * q / 1.3),
                                              beyond.z() * std::sin(2 * kPi * q / 0.9));
  }
};

RigidTransform LookAt(const Vec3& position, const Vec3& target) {
  const Vec3 forward = (target - position).normalized();
  const Vec3 right = forward.cross(Vec3::UnitZ()).normalized();
  RigidTransform pose = RigidTransform::Identity();
  pose.linear() << right, forward.cross(right), forward;
  pose.translation() = position;
  return pose;
}

ArcPath PathAround(const ScanTask& task, double length, const MotionOptions& options,
                   Random& random) {
  ArcPath path;
  path.task = task;
  const double distance = task.standoff + 0.4 * task.object_bounds.sizes().head<2>().norm();
  // About two thirds of the way goes sideways, the rest up and down.
  path.sweep = std::clamp(0.33 * length / distance, 0.1, options.sweep);
  path.sweep_length = 2 * path.sweep * distance;
  path.azimuth_center = options.azimuth + random.Uniform(-8, 8) * kDegree;
  path.phase_elevation = random.Uniform(0, 2 * kPi);
  path.phase_standoff = random.Uniform(0, 2 * kPi);
  return path;
}

// 1 while the camera moves, 0 while it rests; stops and starts within a fifth of a second.
double Going(double time, double pause) {
  constexpr double kMoving = 1.5, kRamp = 0.2;  // chosen: as one scans part by part
  if (pause <= 0) return 1;
  const double at = std::fmod(time, kMoving + pause);
  return std::clamp(std::min(at, kMoving - at) / kRamp, 0.0, 1.0);
}

}  // namespace

void VisitOptions(MotionOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"speed", "m/s", 0.01, 1, "Mean speed of the camera; own choice, .1 to .2."},
                options.speed);
  visitor.Visit({"frame_rate", "1/s", 1, 120, "Frames per second; Kinect V1."}, options.frame_rate);
  visitor.Visit({"standoff", "m", 0, 3,
                 "Mean distance from the object's near side; 0 is the sensor's working distance."},
                options.standoff);
  visitor.Visit({"hand_noise", "", 0, 10, "Factor on the hand's sway and tremor; own choice."},
                options.hand_noise);
  visitor.Visit({"sweep", "rad", 0.1, 1.6, "How far the camera goes to either side; own choice."},
                options.sweep);
  visitor.Visit({"azimuth", "rad", -1.6, 1.6,
                 "Where the middle of its way lies beside the front; own choice."},
                options.azimuth);
  visitor.Visit({"pause", "s", 0, 10, "Its rests after every 1.5 s of motion; own choice."},
                options.pause);
}

std::vector<RigidTransform> HandheldPath(const ScanTask& task, int frames,
                                         const MotionOptions& options, uint64_t seed) {
  Random random(seed, RandomStream::kMotion);
  const double step = 1 / options.frame_rate;
  const ArcPath path = PathAround(task, options.speed * frames * step, options, random);
  const double speed_phase = random.Uniform(0, 2 * kPi);
  const double tremor_phase = random.Uniform(0, 2 * kPi);
  PoseSway sway(0.004 * options.hand_noise, 0.5 * kDegree * options.hand_noise, 0.4, 0.3);
  std::vector<RigidTransform> poses;
  double q = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const double time = frame * step;
    const double tremor = 0.0002 * options.hand_noise * std::sin(2 * kPi * 9 * time + tremor_phase);
    const Vec3 shake = sway.translation() + tremor * Vec3(0.6, 0.8, 0);
    poses.push_back(LookAt(path.Position(q), path.Target(q)) * RigidMotion(sway.rotation(), shake));
    sway.Step(step, random);
    constexpr double kProbe = 1e-4;
    const double metres_per_q = (path.Position(q + kProbe) - path.Position(q)).norm() / kProbe;
    const double speed = options.speed * (1 + std::sin(2 * kPi * time / 3.1 + speed_phase) / 3);
    q += Going(time, options.pause) * speed * step / std::max(metres_per_q, 0.5);
  }
  return poses;
}

}  // namespace curvefusion
