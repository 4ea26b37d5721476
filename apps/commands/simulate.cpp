#include "experiments/simulation/simulate.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "apps/commands/command.h"
#include "apps/output_folder.h"
#include "experiments/simulation/depth_sensor.h"
#include "experiments/simulation/drift.h"
#include "experiments/simulation/families/scan_draw.h"
#include "experiments/simulation/object_truth.h"
#include "experiments/simulation/scan_settings.h"
#include "graph/io/graph_io.h"
#include "kernel/error.h"
#include "kernel/run_lock.h"

namespace curvefusion {

namespace {

constexpr const char* kSmallColor = "640x480";
constexpr const char* kLargeColor = "1280x1024";
constexpr const char* kSpacedObject = "parallel_wires";
constexpr const char* kRandom = "random";

struct SimulateArguments {
  std::string scene;
  std::filesystem::path output;
  std::string color_size = kSmallColor;
  std::optional<double> spacing_mm;
  double wire_diameter_mm = 0;  // 0 = the object's own
  std::string family;
  std::filesystem::path draw;
  std::string registration = RegistrationName(Registration::kRegistered);
  std::string light = LightName(LightKind::kLamp);
  SimulationOptions scan;
  RunOptions run;
};

// An object of the simulator's, or one of the user's from a skeleton file.
void ChooseObject(const std::string& scene, SimulationOptions& scan) {
  const std::filesystem::path path = scene;
  if (path.extension() == ".json") {
    scan.object = path.stem().string();
    scan.object_options.curves = WiresOf(ReadSkeleton(path), scene);
    return;
  }
  scan.object = scene;
  MakeObject(scene, scan.object_options);  // refuses unknown names before anything is written
}

double SpacingOf(const SimulateArguments& arguments) {
  if (!arguments.spacing_mm) return ObjectOptions().spacing;
  if (arguments.scene != kSpacedObject) {
    throw Error(ErrorKind::kUsage, fmt::format("--spacing is for {} only: leave it out for {}",
                                               kSpacedObject, arguments.scene));
  }
  return *arguments.spacing_mm * kMillimetre;
}

// What `random` draws itself must not be given as well.
void RefuseDrawnOptions(const CLI::App& command) {
  static const std::set<std::string> kOwn = {"SCENE",     "--output", "--family", "--draw",
                                             "--seed",    "--frames", "--sensor", "--quiet",
                                             "--threads", "--help"};
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || kOwn.contains(option->get_name())) continue;
    if (kOwn.contains("--" + option->get_single_name())) continue;
    throw Error(ErrorKind::kUsage, option->get_name() +
                                       " is drawn by simulate random: leave it out, or name an "
                                       "object");
  }
}

// A scan whose everything but the number of frames is drawn, or was drawn earlier.
SimulationOptions RandomScan(const CLI::App& command, const SimulateArguments& arguments) {
  RefuseDrawnOptions(command);
  if (arguments.family.empty() == arguments.draw.empty()) {
    throw Error(ErrorKind::kUsage,
                "simulate random needs --family (with --seed), or --draw with the settings.json of "
                "an earlier scan");
  }
  const std::string sensor = command.count("--sensor") > 0 ? arguments.scan.sensor : "";
  if (!arguments.draw.empty() && !sensor.empty()) {
    throw Error(ErrorKind::kUsage, "--draw has a sensor already: leave out --sensor");
  }
  SimulationOptions scan = arguments.draw.empty()
                               ? DrawScan(arguments.family, arguments.scan.seed, sensor)
                               : ReadScanSettings(arguments.draw);
  if (command.count("--frames") > 0) scan.frames = arguments.scan.frames;
  return scan;
}

SimulationOptions ChosenScan(SimulateArguments& arguments) {
  if (!arguments.family.empty() || !arguments.draw.empty()) {
    throw Error(ErrorKind::kUsage, "--family and --draw are for simulate random only");
  }
  SimulationOptions& scan = arguments.scan;
  scan.large_color = arguments.color_size == kLargeColor;
  scan.object_options.spacing = SpacingOf(arguments);
  scan.object_options.wire_diameter = arguments.wire_diameter_mm * kMillimetre;
  scan.color.registration = RegistrationOf(arguments.registration);
  scan.scene.light = LightOf(arguments.light);
  ChooseObject(arguments.scene, scan);
  return scan;
}

// Beside the folder, which appears only in the end.
RunLock LockOf(const std::filesystem::path& folder) {
  std::filesystem::path named = std::filesystem::absolute(folder).lexically_normal();
  if (!named.has_filename()) named = named.parent_path();
  MakeOutputFolder(named.parent_path());
  return {named.string() + ".lock", folder};
}

int RunSimulate(const CLI::App& command, SimulateArguments arguments) {
  const bool random = arguments.scene == kRandom;
  const SimulationOptions scan = random ? RandomScan(command, arguments) : ChosenScan(arguments);
  const RunLock lock = LockOf(arguments.output);
  ProgressPrinter printer = MakeProgressPrinter(arguments.run.quiet);
  LimitThreads(arguments.run);
  SimulateScan(scan, arguments.output, InterruptibleProgress(printer));
  printer.Finish();
  if (!arguments.run.quiet) {
    fmt::print("Simulated {} frames of {}\n  scan   {}\n  truth  {}\n", scan.frames, scan.object,
               arguments.output.string(), (arguments.output / "truth").string());
  }
  return 0;
}

void AddSensorOptions(CLI::App& command, SimulateArguments& arguments) {
  command.option_defaults()->group("Sensor");
  SimulationOptions& scan = arguments.scan;
  command.add_option("--sensor", scan.sensor, "The depth camera")
      ->check(CLI::IsMember(SensorNames()));
  command
      .add_option("--rgb", arguments.color_size,
                  "Size of colour images: 640x480 (as depth) or 1280x1024 (twice the resolution)")
      ->check(CLI::IsMember({kSmallColor, kLargeColor}));
  command
      .add_option("--readout-time", scan.readout_time,
                  "Seconds from the first to the last row (rolling shutter; 0.028 for a Kinect V1)")
      ->check(CLI::Range(0.0, 0.033));
  command
      .add_option("--speckle-filter", scan.matching.drop_small_components,
                  "Whether kinect_v1 and primesense drop small components of depth, as the real "
                  "ones do: on or off")
      ->default_str("on");
}

void AddColorOptions(CLI::App& command, SimulateArguments& arguments) {
  command.option_defaults()->group("Colour");
  ColorOptions& color = arguments.scan.color;
  command
      .add_option("--registration", arguments.registration,
                  "Colour camera: registered (viewpoint of depth), or its own with exact, "
                  "calibrated (slightly wrong) or no (raw) calibration")
      ->check(CLI::IsMember(RegistrationNames()));
  command
      .add_option("--registration-error", arguments.scan.registration_error_px,
                  "Error of registered and calibrated colour in depth pixels")
      ->check(CLI::Range(0.0, 20.0));
  command
      .add_option("--exposure-time", color.exposure_time,
                  "Exposure time in seconds, in which motion blurs an image")
      ->check(CLI::Range(0.0, 0.033));
  command
      .add_option("--exposure-drift", color.exposure_drift,
                  "Standard deviation of the exposure over the scan in stops")
      ->check(CLI::Range(0.0, 3.0));
  command
      .add_option("--white-balance-drift", color.white_balance_drift,
                  "Standard deviation of the gain of red and blue against green")
      ->check(CLI::Range(0.0, 0.5));
  command.add_option("--vignetting", color.vignetting, "Share of light missing in the corners")
      ->check(CLI::Range(0.0, 0.9));
  command
      .add_option("--light", arguments.light,
                  "lamp: one lamp and ambient light; side; several; diffuse: ambient light alone")
      ->check(CLI::IsMember(LightNames()));
}

void AddMotionOptions(CLI::App& command, SimulateArguments& arguments) {
  command.option_defaults()->group("Motion and poses");
  SimulationOptions& scan = arguments.scan;
  command.add_option("--frames", scan.frames, "Number of frames")->check(CLI::Range(1, 100000));
  command.add_option("--frame-rate", scan.motion.frame_rate, "Frames per second")
      ->check(CLI::Range(1.0, 120.0));
  command.add_option("--speed", scan.motion.speed, "Mean speed of the camera in m/s")
      ->check(CLI::Range(0.01, 1.0));
  command
      .add_option("--distance", scan.motion.standoff,
                  "Mean distance to the object in m; otherwise the sensor's working distance")
      ->default_str("")
      ->check(CLI::Range(0.2, 3.0));
  command.add_option("--poses", scan.pose_source, "Where poses come from, with its errors")
      ->check(CLI::IsMember(PoseSourceNames()));
  command.add_option("--pose-error", scan.pose_error_scale, "Factor on the errors of --poses")
      ->check(CLI::Range(0.0, 10.0));
}

void AddWireOptions(CLI::App& command, SimulateArguments& arguments) {
  command.option_defaults()->group("Wires");
  SceneOptions& scene = arguments.scan.scene;
  command
      .add_option("--wire-diameter", arguments.wire_diameter_mm,
                  "Diameter of all wires in mm; otherwise the object's own")
      ->default_str("")
      ->check(CLI::Range(0.1, 50.0));
  command
      .add_option("--spacing", arguments.spacing_mm,
                  "Between the axes of parallel_wires in mm, 20 otherwise")
      ->check(CLI::Range(5.0, 100.0));
  command
      .add_option("--wire-albedo", scene.wire_albedo,
                  "Brightness of the wires in colour and infrared: 0.05 black, 0.9 white")
      ->check(CLI::Range(0.0, 1.0));
  command
      .add_option("--wire-infrared", scene.wire_infrared_albedo,
                  "Brightness of the wires in infrared alone; otherwise as in colour")
      ->default_str("")
      ->check(CLI::Range(0.0, 1.0));
  command.add_option("--wire-hue", scene.wire_hue, "From red (0) over green and blue to red (1)")
      ->check(CLI::Range(0.0, 1.0));
  command.add_option("--wire-saturation", scene.wire_saturation, "From grey (0) to saturated (1)")
      ->check(CLI::Range(0.0, 1.0));
  command.add_flag("--wire-like-background", scene.wire_like_background,
                   "Wires of the colour of the wall behind them");
  command
      .add_option("--wire-shininess", scene.wire_shininess, "From 0 (matt) to 1 (like a mirror)")
      ->check(CLI::Range(0.0, 1.0));
}

}  // namespace

void AddSimulateCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "simulate", "Simulate a handheld scan of a known object, with its truth beside it");
  const auto arguments = std::make_shared<SimulateArguments>();
  command
      ->add_option("SCENE", arguments->scene,
                   "An object: " + CLI::detail::join(ObjectNames(), ", ") +
                       "; or a skeleton.json with radii; or random")
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "Folder for the sequence, which must be new or empty")
      ->required();
  command->option_defaults()->always_capture_default();
  AddSensorOptions(*command, *arguments);
  AddColorOptions(*command, *arguments);
  AddMotionOptions(*command, *arguments);
  AddWireOptions(*command, *arguments);
  command->option_defaults()->group("Random scans");
  command
      ->add_option("--family", arguments->family,
                   "Of random: object, room, camera, colours, light, path and poses are drawn from "
                   "the seed")
      ->check(CLI::IsMember(FamilyNames()));
  command
      ->add_option("--draw", arguments->draw,
                   "With random: truth/settings.json of a scan to simulate again")
      ->check(CLI::ExistingFile);
  command->option_defaults()->group("Run");
  command->add_option("--seed", arguments->scan.seed, "Seed of room, path and noise");
  AddRunOptions(*command, arguments->run);
  command->footer(
      "The folder appears when the scan is complete. The same options and seed give the same "
      "bytes.\n"
      "Example:\n  curvefusion simulate cage -o scans/cage --frames 227\n"
      "  curvefusion simulate parallel_wires -o scans/close --spacing 12 --seed 2\n"
      "  curvefusion simulate random --family tree --seed 7 -o scans/tree_7\n"
      "  curvefusion simulate my_object.json -o scans/mine --rgb 1280x1024 --wire-albedo 0.05");
  command->callback(
      [command, arguments, &exit_code] { exit_code = RunSimulate(*command, *arguments); });
}

}  // namespace curvefusion
