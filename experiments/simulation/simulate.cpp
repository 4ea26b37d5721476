#include "experiments/simulation/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numbers>

#include "capture/camera_json.h"
#include "capture/trajectory.h"
#include "experiments/simulation/color_plan.h"
#include "experiments/simulation/depth_sensor.h"
#include "experiments/simulation/drift.h"
#include "experiments/simulation/object_truth.h"
#include "experiments/simulation/random.h"
#include "experiments/simulation/scan_files.h"
#include "experiments/simulation/scan_settings.h"
#include "experiments/simulation/solid_objects.h"
#include "graph/io/graph_io.h"
#include "kernel/atomic_file.h"
#include "kernel/error.h"
#include "kernel/free_space.h"
#include "kernel/options.h"
#include "kernel/parallel.h"
#include "meshing/hybrid_mesh.h"
#include "meshing/io/mesh_io.h"
#include "meshing/tubes.h"

namespace curvefusion {
namespace {

// Everything about a scan but its images.
struct ScanPlan {
  Scene scene;
  std::unique_ptr<DepthSensor> sensor;
  ColorPlan color;
  Vec2 color_shift_px = Vec2::Zero();
  std::vector<RigidTransform> true_poses;
  std::vector<std::string> frame_names;
};

void CheckOptions(const SimulationOptions& options) {
  if (options.frames < 1) {
    throw Error(ErrorKind::kUsage,
                "a scan needs at least 1 frame, not " + std::to_string(options.frames));
  }
  if (options.readout_time * options.motion.frame_rate > 1) {
    throw Error(ErrorKind::kUsage,
                fmt::format("rows cannot be read for {} s at {} frames a second: lower the readout "
                            "time or the frame rate",
                            options.readout_time, options.motion.frame_rate));
  }
  if (options.color.exposure_time * options.motion.frame_rate > 1) {
    throw Error(ErrorKind::kUsage,
                fmt::format("images cannot be exposed for {} s at {} frames a second: lower the "
                            "exposure time or the frame rate",
                            options.color.exposure_time, options.motion.frame_rate));
  }
}

// A shift of the given length in a direction of the seed's.
Vec2 RegistrationShift(const SimulationOptions& options) {
  Random random(options.seed, RandomStream::kRegistration);
  const double angle = random.Uniform(0, 2 * std::numbers::pi);
  return options.registration_error_px * Vec2(std::cos(angle), std::sin(angle));
}

// The distance from the object, which the sensor must be able to measure.
double Standoff(const SimulationOptions& options, const DepthSensor& sensor) {
  const double standoff = options.motion.standoff;
  if (standoff <= 0) return sensor.WorkingDistance();
  const DepthRange range = sensor.Range();
  if (standoff < range.nearest || standoff > range.farthest) {
    throw Error(ErrorKind::kUsage,
                fmt::format("{} measures from {} to {} m: it cannot be held at a distance of {} m",
                            options.sensor, range.nearest, range.farthest, standoff));
  }
  return standoff;
}

ScanTask TaskOf(const Scene& scene, const DepthSensor& sensor, double standoff) {
  ScanTask task;
  task.object_bounds = scene.object_bounds;
  task.table_height = scene.TableHeight();
  task.standoff = standoff;
  task.view_half_height = task.standoff * sensor.camera().height / sensor.camera().fy / 2;
  return task;
}

ScanPlan PlanScan(const SimulationOptions& options) {
  ScanPlan plan;
  plan.scene =
      MakeScene(MakeObject(options.object, options.object_options), options.scene, options.seed);
  plan.sensor = MakeDepthSensor(options.sensor, options.seed, options.matching);
  plan.color =
      PlanColor(options.color, plan.sensor->camera().Scaled(plan.sensor->ColorScale()),
                options.large_color, options.frames, options.motion.frame_rate, options.seed);
  plan.color_shift_px = RegistrationShift(options);
  const ScanTask task = TaskOf(plan.scene, *plan.sensor, Standoff(options, *plan.sensor));
  plan.true_poses = HandheldPath(task, options.frames, options.motion, options.seed);
  for (int frame = 0; frame < options.frames; ++frame) {
    plan.frame_names.push_back(FrameName(frame, options.motion.frame_rate));
  }
  return plan;
}

// The pose `share` of the way from a frame to the next (negative: towards the one before).
RigidTransform PoseNear(const std::vector<RigidTransform>& poses, int frame, double share) {
  const int other = std::clamp(frame + (share < 0 ? -1 : 1), 0, static_cast<int>(poses.size()) - 1);
  const double t = std::abs(share);
  if (t == 0) return poses[frame];
  const Eigen::Quaterniond from(poses[frame].rotation());
  const Eigen::Quaterniond to(poses[other].rotation());
  RigidTransform pose = RigidTransform::Identity();
  pose.linear() = from.slerp(t, to).toRotationMatrix();
  pose.translation() = (1 - t) * poses[frame].translation() + t * poses[other].translation();
  return pose;
}

// The camera while the rows of a frame are read, `delay` seconds late. A frame's pose is that of
// its middle row.
Exposure ExposureOf(const ScanPlan& plan, const SimulationOptions& options, int frame,
                    double delay = 0) {
  const double half = options.readout_time * options.motion.frame_rate / 2;
  const double late = delay * options.motion.frame_rate;
  return {PoseNear(plan.true_poses, frame, late - half),
          PoseNear(plan.true_poses, frame, late + half), static_cast<uint64_t>(frame)};
}

// By how many pixels the object's centre moves in the colour image between two poses.
double Displacement(const ScanPlan& plan, const RigidTransform& T_world_from,
                    const RigidTransform& T_world_to) {
  const PinholeCamera& camera = plan.color.camera.camera;
  const Vec3 from = T_world_from.inverse() * Vec3::Zero();
  const Vec3 to = T_world_to.inverse() * Vec3::Zero();
  if (from.z() <= 0 || to.z() <= 0) return 0;
  return (camera.Project(from) - camera.Project(to)).norm();
}

// At least one moment for every pixel of motion, but at most 8.
std::vector<Exposure> Moments(const ScanPlan& plan, const SimulationOptions& options, int frame) {
  const double time = options.color.exposure_time;
  const double pixels =
      Displacement(plan, ExposureOf(plan, options, frame, -time / 2).T_world_first,
                   ExposureOf(plan, options, frame, time / 2).T_world_first);
  const auto count =
      static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::ceil(std::min(pixels, 8.0)))));
  std::vector<Exposure> moments;
  for (int k = 0; k < count; ++k) {
    moments.push_back(ExposureOf(plan, options, frame, ((k + 0.5) / count - 0.5) * time));
    moments.back().T_world_first = moments.back().T_world_first * plan.color.T_depth_color;
    moments.back().T_world_last = moments.back().T_world_last * plan.color.T_depth_color;
  }
  return moments;
}

ColorShot ShotOf(const ScanPlan& plan, const SimulationOptions& options, int frame) {
  ColorShot shot;
  shot.moments = Moments(plan, options, frame);
  shot.gain = plan.color.gains[frame];
  if (plan.color.shifts) {
    Random random(options.seed, RandomStream::kRegistration, static_cast<uint64_t>(frame) + 1);
    const Vec2 jitter = options.registration_jitter_px * Vec2(random.Normal(), random.Normal());
    const double scale = plan.color.camera.camera.fx / plan.sensor->camera().fx;
    shot.shift_px = scale * (plan.color_shift_px + jitter);
  }
  return shot;
}

void TakeFrame(const ScanPlan& plan, const SimulationOptions& options, int frame,
               const std::filesystem::path& folder) {
  const std::string& name = plan.frame_names[frame];
  WriteDepthPng(folder / "depth" / (name + ".png"),
                plan.sensor->Measure(plan.scene, ExposureOf(plan, options, frame)));
  const ColorImage color =
      RenderColor(plan.scene, ShotOf(plan, options, frame), plan.color.camera, options.seed);
  WriteColorJpeg(folder / "rgb" / (name + ".jpg"), color);
}

void TakeFrames(const ScanPlan& plan, const SimulationOptions& options,
                const std::filesystem::path& folder, const Progress& progress) {
  for (const char* part : {"depth", "rgb"}) std::filesystem::create_directory(folder / part);
  std::mutex progress_mutex;
  int done = 0;
  ParallelFor(0, options.frames, 1, [&](int64_t frame) {
    TakeFrame(plan, options, static_cast<int>(frame), folder);
    const std::lock_guard<std::mutex> lock(progress_mutex);
    progress("simulate", ++done, options.frames);
  });
}

nlohmann::ordered_json JsonOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::ordered_json SceneJson(const ScanPlan& plan, const SimulationOptions& options) {
  nlohmann::ordered_json json = {{"object", options.object},
                                 {"sensor", options.sensor},
                                 {"pose_source", options.pose_source},
                                 {"pose_error_scale", options.pose_error_scale},
                                 {"seed", options.seed},
                                 {"wire_albedo", options.scene.wire_albedo},
                                 {"wire_shininess", options.scene.wire_shininess},
                                 {"readout_time", options.readout_time},
                                 {"light", LightName(options.scene.light)},
                                 {"registration", RegistrationName(options.color.registration)}};
  json["color_camera"] = CameraJson(plan.color.camera.camera);
  json["color_position"] = JsonOf(plan.color.T_depth_color.translation());
  json["color_shift_px"] = {plan.color_shift_px.x(), plan.color_shift_px.y()};
  for (const ScenePlane& plane : plan.scene.planes) {
    json["planes"].push_back({{"normal", JsonOf(plane.normal)}, {"offset", plane.offset}});
  }
  constexpr const char* kShapes[] = {"box", "ellipsoid", "cylinder"};
  for (const SceneBox& box : plan.scene.boxes) {
    json["boxes"].push_back({{"shape", kShapes[static_cast<int>(box.shape)]},
                             {"center", JsonOf(box.center)},
                             {"half_size", JsonOf(box.half_size)},
                             {"x_axis", JsonOf(box.rotation.col(0))},
                             {"z_axis", JsonOf(box.rotation.col(2))},
                             {"wall", box.wall}});
  }
  for (const SceneCapsule& capsule : plan.scene.capsules) {
    if (capsule.material == 0) continue;  // a wire
    json["capsules"].push_back({{"start", JsonOf(capsule.start)},
                                {"end", JsonOf(capsule.end)},
                                {"radius", capsule.radius}});
  }
  return json;
}

Trajectory TrajectoryOf(const std::vector<RigidTransform>& poses,
                        const SimulationOptions& options) {
  Trajectory trajectory;
  for (const RigidTransform& T_world_camera : poses) {
    const int frame = static_cast<int>(trajectory.size());
    trajectory.push_back({FrameTime(frame, options.motion.frame_rate), T_world_camera});
  }
  return trajectory;
}

// Of an object with solid parts, which are the scene's last boxes: wires and parts united.
void WriteTrueSurface(const Scene& scene, const WireObject& object,
                      const std::filesystem::path& path) {
  std::vector<TriangleMesh> solids;
  for (size_t i = scene.boxes.size() - SolidsOf(object).size(); i < scene.boxes.size(); ++i) {
    solids.push_back(SurfaceOf(scene.boxes[i]));
  }
  if (solids.empty()) return;
  const TubeMesh tubes = BuildTubes(TruthSkeleton(scene.object), {});
  const double radius = object.curves.front().diameter / 2;
  WriteMesh(path, UniteTubesAndSolids(ToTriangleMesh(tubes.surface), solids, radius).mesh, {});
}

void WriteTruth(const ScanPlan& plan, const SimulationOptions& options,
                const std::filesystem::path& folder) {
  std::filesystem::create_directory(folder);
  WriteSkeleton(folder / "skeleton.json", TruthSkeleton(plan.scene.object));
  WriteCurves(folder / "curves.json", plan.scene.object);
  WriteTrueSurface(plan.scene, MakeObject(options.object, options.object_options),
                   folder / "surface.ply");
  WriteTumTrajectory(folder / "trajectory.txt", TrajectoryOf(plan.true_poses, options));
  const nlohmann::ordered_json scene = SceneJson(plan, options);
  WriteStreamAtomically(folder / "scene.json",
                        [&](std::ostream& stream) { stream << scene.dump(1) << "\n"; });
  WriteStreamAtomically(folder / "settings.json",
                        [&](std::ostream& stream) { stream << ScanSettings(options) << "\n"; });
}

}  // namespace

void VisitOptions(SimulationOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"frames", "frames", 1, 100000, "Length of the scan; CurveFusion, Table 1."},
                options.frames);
  visitor.Visit({"pose_error_scale", "", 0, 10, "Factor on the errors of the poses; own choice."},
                options.pose_error_scale);
  visitor.Visit({"large_color", "", 0, 1,
                 "Colour at twice the resolution (1280x1024 for a Kinect V1); CurveFusion 5, RGB "
                 "resolutions."},
                options.large_color);
  visitor.Visit({"registration_error_px", "px", 0, 20,
                 "Fixed shift between depth and colour: 1 calibrated, 2 to 5 as delivered."},
                options.registration_error_px);
  visitor.Visit({"registration_jitter_px", "px", 0, 5,
                 "Change of that shift from frame to frame; own choice."},
                options.registration_jitter_px);
  visitor.Visit({"readout_time", "s", 0, 0.033,
                 "Time from the first to the last row of an image; about .028 for a Kinect V1."},
                options.readout_time);
  visitor.Visit({"wire_diameter", "m", 0, 0.05, "Diameter of all wires; 0 keeps the object's own."},
                options.object_options.wire_diameter);
  visitor.Visit({"spacing", "m", 0.005, 0.1, "Between the axes of parallel_wires."},
                options.object_options.spacing);
  VisitOptions(options.color, visitor);
  VisitOptions(options.scene, visitor);
  VisitOptions(options.motion, visitor);
  VisitOptions(options.matching, visitor);
}

std::uintmax_t ScanBytes(const SimulationOptions& options) {
  // Measured (simulate cage --frames 2 with each sensor and size of colour; du -sb depth rgb): at
  // most 351 and 123 kB, 330 kB for large colour.
  constexpr std::uintmax_t kDepthBytes = 360000;
  constexpr std::uintmax_t kColorBytes = 140000;
  // A sensor whose colour has more pixels than its depth takes as much more.
  const double scale = MakeDepthSensor(options.sensor, options.seed)->ColorScale();
  const auto color_bytes = static_cast<std::uintmax_t>(kColorBytes * std::max(1.0, scale));
  const std::uintmax_t frame = kDepthBytes + color_bytes * (options.large_color ? 4 : 1);
  return frame * static_cast<std::uintmax_t>(options.frames);
}

void SimulateScan(const SimulationOptions& options, const std::filesystem::path& folder,
                  const Progress& progress) {
  CheckOptions(options);
  const PoseErrorModel pose_errors = PoseErrorOf(options.pose_source, options.pose_error_scale);
  const ScanPlan plan = PlanScan(options);
  RequireFreeSpace(folder, ScanBytes(options));
  WriteFolderAtomically(folder, [&](const std::filesystem::path& scan) {
    TakeFrames(plan, options, scan, progress);
    WriteTruth(plan, options, scan / "truth");
    WriteIntrinsics(scan / "intrinsics.json", plan.sensor->camera(), plan.color.told_camera,
                    plan.color.T_told_color_depth);
    const std::vector<RigidTransform> drifted_poses =
        DriftedPoses(plan.true_poses, options.motion.frame_rate, pose_errors, options.seed);
    WriteTumTrajectory(scan / "trajectory.txt", TrajectoryOf(drifted_poses, options));
    WriteFrameLists(scan, plan.frame_names);
  });
}

}  // namespace curvefusion
