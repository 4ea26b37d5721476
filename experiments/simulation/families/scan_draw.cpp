#include "experiments/simulation/families/scan_draw.h"

#include <algorithm>
#include <cmath>

#include "experiments/simulation/families/families.h"
#include "experiments/simulation/random.h"
#include "kernel/angle.h"
#include "kernel/error.h"
#include "kernel/options.h"

namespace curvefusion {
namespace {

constexpr const char* kFurnished = "furnished";
constexpr const char* kRoom = "room";
constexpr uint64_t kMostFamilies = 64;
constexpr const char* kPhone = "phone";
constexpr double kPhoneShift = 0.5;  // pixels of depth. Chosen: a pixel of depth is 7.5 of colour

// One of several, by weights.
template <class Choice, size_t count>
const Choice& Drawn(Random& random, const Choice (&choices)[count]) {
  double total = 0;
  for (const Choice& choice : choices) total += choice.weight;
  double at = random.Uniform(0, total);
  for (const Choice& choice : choices) {
    at -= choice.weight;
    if (at < 0) return choice;
  }
  return choices[count - 1];
}

void DrawObject(const std::string& family, Random& random, SimulationOptions& scan) {
  const std::vector<std::string> shapes = ShapeFamilyNames();
  scan.object = family;
  if (family == kFurnished) scan.object = shapes[random.Next() % shapes.size()];
  if (family == kRoom) {
    scan.object = "empty";
  } else {
    scan.object_options.shape_seed = scan.seed;
  }
  const bool furnished = family == kFurnished || family == kRoom;
  scan.scene.furniture = furnished ? random.Integer(12, 30) : random.Integer(0, 4);
}

struct Camera {
  double weight;
  const char* name;
  double nearest, farthest;
};

// Mostly structured light, as in the recordings at hand; distances at which one would hold each.
// Those of no weight are held only if asked for; the last is one that may be drawn.
constexpr Camera kCameras[] = {{0, "d455", 0.45, 0.65},         {0, kPhone, 0.35, 0.6},
                               {0.45, "kinect_v1", 0.45, 0.65}, {0.25, "primesense", 0.42, 0.65},
                               {0.12, "d400", 0.35, 0.6},       {0.08, "azure_kinect", 0.55, 0.8},
                               {0.05, "kinect_v2", 0.6, 0.8},   {0.05, "sr300", 0.3, 0.6}};

const Camera& CameraOf(const std::string& sensor) {
  for (const Camera& camera : kCameras)
    if (camera.name == sensor) return camera;
  throw Error(ErrorKind::kUsage, "no scan is drawn with the sensor " + sensor +
                                     ": name one that people hold, such as kinect_v1 or phone");
}

void DrawSensor(const std::string& sensor, Random& random, SimulationOptions& scan) {
  const Camera& drawn = Drawn(random, kCameras);
  const Camera& camera = sensor.empty() ? drawn : CameraOf(sensor);
  scan.sensor = camera.name;
  scan.motion.standoff = random.Uniform(camera.nearest, camera.farthest);
  scan.readout_time = random.Chance(0.5) ? random.Uniform(0.01, 0.03) : 0;
}

// The colour camera's place, what its driver tells of it, and how it takes its pictures.
void DrawColorCamera(Random& random, SimulationOptions& scan) {
  struct Kind {
    double weight;
    Registration registration;
    double error_low, error_high;  // px
  };
  static constexpr Kind kKinds[] = {{0.3, Registration::kRegistered, 0, 1},
                                    {0.2, Registration::kRegistered, 1, 5},
                                    {0.15, Registration::kExact, 0, 0},
                                    {0.2, Registration::kCalibrated, 0.5, 1.5},
                                    {0.15, Registration::kRaw, 0, 0}};
  const Kind& kind = Drawn(random, kKinds);
  scan.color.registration = kind.registration;
  scan.registration_error_px = random.Uniform(kind.error_low, kind.error_high);
  scan.registration_jitter_px = random.Uniform(0, 0.7);
  scan.color.focal_length_px = random.Uniform(515, 545);
  scan.color.center_u_px = random.Uniform(-5, 5);
  scan.color.center_v_px = random.Uniform(-8, 4);
  scan.color.baseline = random.Uniform(0.02, 0.03);
  // Blur costs: one rendering a pixel of motion.
  scan.color.exposure_time = random.Chance(0.3) ? random.Uniform(0.003, 0.012) : 0;
  scan.color.exposure_drift = random.Uniform(0, 0.3);
  scan.color.white_balance_drift = random.Uniform(0, 0.08);
  scan.color.vignetting = random.Uniform(0, 0.35);
}

// A phone's driver lays depth onto colour, and tells poses of its own.
void TakeByPhone(SimulationOptions& scan) {
  scan.pose_source = "arkit";
  scan.color.registration = Registration::kRegistered;
  scan.registration_error_px = std::min(scan.registration_error_px, kPhoneShift);
  scan.registration_jitter_px = 0;
}

// Half of the scans have fewer than 70 frames, one in ten more than 200: what a study of 120 scans
// can afford in an hour and a half on two cores (docs/simulator.md).
void DrawPath(Random& random, SimulationOptions& scan) {
  scan.frames =
      static_cast<int>(std::lround(60 * std::pow(400.0 / 60, std::pow(random.Uniform(), 4))));
  // Short recordings are thinned ones of 6 to 14 seconds.
  scan.motion.frame_rate = std::clamp(scan.frames / random.Uniform(6, 14), 5.0, 30.0);
  scan.motion.speed = random.Uniform(0.1, 0.2);
  struct Style {
    double weight;
    double hand_low, hand_high;    // factor on the hand's noise
    double sweep_low, sweep_high;  // degrees to either side
    double azimuth;                // degrees that its middle may lie beside the front
    double pause_low, pause_high;  // seconds of rest
  };
  static constexpr Style kStyles[] = {{0.4, 0.5, 1.2, 40, 60, 10, 0, 0},      // arcs
                                      {0.25, 1.2, 3, 25, 60, 20, 0, 0},       // an unsteady hand
                                      {0.2, 0.5, 1.5, 30, 60, 15, 0.4, 1.5},  // stop and go
                                      {0.15, 0.5, 1.5, 10, 22, 35, 0, 0}};    // one side only
  const Style& style = Drawn(random, kStyles);
  scan.motion.hand_noise = random.Uniform(style.hand_low, style.hand_high);
  scan.motion.sweep = random.Uniform(style.sweep_low, style.sweep_high) * kDegree;
  scan.motion.azimuth = random.Uniform(-style.azimuth, style.azimuth) * kDegree;
  scan.motion.pause = random.Uniform(style.pause_low, style.pause_high);
}

// What makes depth disagree as in the recorded kitchen came later: it is drawn last and takes its
// share of all others alike, so that every scan which does not have it is as it was.
void DrawPoses(Random& random, SimulationOptions& scan) {
  constexpr double kKitchenShare = 0.15;  // chosen

  struct Source {
    double weight;
    const char* name;
  };
  static constexpr Source kSources[] = {
      {0.4, "orbslam2"}, {0.3, "bundlefusion"}, {0.2, "kinfu"}, {0.05, "ptam"}, {0.05, "true"}};
  scan.pose_source = Drawn(random, kSources).name;
  scan.pose_error_scale = random.LogUniform(0.5, 1.6);
  if (random.Chance(kKitchenShare)) scan.pose_source = "kitchen";
}

// Of the wires, and the light on all.
void DrawColors(Random& random, SimulationOptions& scan) {
  struct Paint {
    double weight;
    double albedo_low, albedo_high;
    double saturation_low, saturation_high;
    double infrared_low, infrared_high;  // below 0: as bright as in colour
    bool like_background;
  };
  static constexpr Paint kPaints[] = {
      {0.35, 0.35, 0.85, 0.35, 0.9, -1, -1, false},  // a clear colour
      {0.2, 0.75, 0.95, 0, 0.08, -1, -1, false},     // white
      {0.15, 0.3, 0.65, 0, 0.1, -1, -1, false},      // grey
      {0.15, 0.03, 0.1, 0, 0.2, 0.35, 0.7, false},   // black, but bright in infrared
      {0.15, 0.5, 0.5, 0.5, 0.5, 0.4, 0.8, true}};   // of the wall's colour
  const Paint& paint = Drawn(random, kPaints);
  scan.scene.wire_albedo = random.Uniform(paint.albedo_low, paint.albedo_high);
  scan.scene.wire_saturation = random.Uniform(paint.saturation_low, paint.saturation_high);
  scan.scene.wire_infrared_albedo = random.Uniform(paint.infrared_low, paint.infrared_high);
  scan.scene.wire_like_background = paint.like_background;
  scan.scene.wire_hue = random.Uniform();
  scan.scene.wire_shininess = random.Chance(0.3) ? random.Uniform(0.05, 0.4) : 0;
  struct Light {
    double weight;
    LightKind kind;
  };
  static constexpr Light kLights[] = {{0.3, LightKind::kLamp},
                                      {0.25, LightKind::kSide},
                                      {0.3, LightKind::kSeveral},
                                      {0.15, LightKind::kDiffuse}};
  scan.scene.light = Drawn(random, kLights).kind;
}

double Difference(const Vec3& a, const Vec3& b) { return (a - b).norm() / std::sqrt(3.0); }

}  // namespace

std::vector<std::string> FamilyNames() {
  std::vector<std::string> names = ShapeFamilyNames();
  names.emplace_back(kFurnished);
  names.emplace_back(kRoom);
  return names;
}

SimulationOptions DrawScan(const std::string& family, uint64_t seed,
                           const std::string& sensor_name) {
  const std::vector<std::string> names = FamilyNames();
  const auto place = std::find(names.begin(), names.end(), family);
  if (place == names.end()) {
    throw Error(ErrorKind::kUsage, "there is no family " + family + "; did you mean " +
                                       NearestName(family, names) + "?");
  }
  SimulationOptions scan;
  // Of its own for every family, or rooms, paths and noise of all families would be the same.
  scan.seed = kMostFamilies * seed + static_cast<uint64_t>(place - names.begin());
  // Each kind of choice has its own stream: a change of one leaves the others.
  const auto stream = [&](uint64_t kind) { return Random(scan.seed, RandomStream::kDraw, kind); };
  Random object = stream(0), sensor = stream(1), path = stream(2), poses = stream(3);
  Random colors = stream(4), camera = stream(5);
  DrawObject(family, object, scan);
  DrawSensor(sensor_name, sensor, scan);
  DrawPath(path, scan);
  DrawPoses(poses, scan);
  DrawColors(colors, scan);
  DrawColorCamera(camera, scan);
  if (scan.sensor == kPhone) TakeByPhone(scan);
  return scan;
}

double ColorContrast(const Scene& scene) {
  if (scene.object.curves.empty()) return 0;
  constexpr size_t kTable = 1, kWall = 2;  // behind the wires' material come the planes'
  const Vec3& wire = scene.materials.front().color;
  return std::min(Difference(wire, scene.materials[kTable].color),
                  Difference(wire, scene.materials[kWall].color));
}

}  // namespace curvefusion
