#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/commands/command.h"
#include "apps/commands/config_arguments.h"
#include "apps/output_guard.h"
#include "apps/result_run.h"
#include "apps/shard_result.h"
#include "experiments/shard_run.h"
#include "kernel/error.h"
#include "kernel/free_space.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

struct ReconstructArguments {
  fs::path sequence;
  fs::path output;
  ConfigArguments config;
  bool force = false;
  bool track = false;
  std::string depth;  // empty: as the config says
  StageOutputs stages;
  std::string colour_camera = "auto";
  bool hybrid = false;
  std::string shard;             // "2/4"
  std::vector<fs::path> shards;  // to be merged
  RunOptions run;
};

void RequireInputStays(const ReconstructArguments& arguments) {
  const fs::path& volume = arguments.stages.volume;
  for (const fs::path& output : {arguments.output, arguments.stages.folder, volume}) {
    RequireOutside(arguments.sequence, output);
  }
  RequireApart({arguments.config.file}, arguments.output / "config.toml");
  RequireApart({arguments.config.file}, volume);
}

void RequireRoom(const ReconstructArguments& arguments, const Sequence& sequence) {
  // Chosen: five times what a wire cube takes, whose result has 3 MB, volume 1 MB.
  constexpr std::uintmax_t kFiles = 16u << 20;
  // Measured (25 frames of that cube, --save-stages): 57 kB a frame; the double for larger objects.
  constexpr std::uintmax_t kStagesOfFrame = 114000;
  RequireFreeSpace(arguments.output, kFiles);
  const auto frames = static_cast<std::uintmax_t>(sequence.frame_count());
  const StageOutputs& stages = arguments.stages;
  if (!stages.folder.empty()) RequireFreeSpace(stages.folder, kStagesOfFrame * frames);
  if (!stages.volume.empty()) RequireFreeSpace(stages.volume, kFiles);
}

// The result, and all that is written beside it, is made by the run that merges.
void RequireShardsPossible(const ReconstructArguments& arguments, const Config& config) {
  if (!arguments.shards.empty() || !arguments.shard.empty()) OptionsOfShards(config);
  if (arguments.shard.empty()) return;
  ParseShard(arguments.shard);
  const StageOutputs& stages = arguments.stages;
  const char* other = !arguments.shards.empty() ? "--merge"
                      : arguments.hybrid        ? "--hybrid"
                      : !stages.folder.empty()  ? "--save-stages"
                      : !stages.volume.empty()  ? "--save-volume"
                                                : nullptr;
  if (other == nullptr) return;
  throw Error(ErrorKind::kUsage, std::string("--shard writes one shard alone: give ") + other +
                                     " to the run that merges all of them");
}

int RunShard(const ReconstructArguments& arguments, const ShardedRun& run, Sequence sequence) {
  RequireOutside(arguments.sequence, arguments.output);
  ProgressPrinter printer = MakeProgressPrinter(arguments.run.quiet);
  return WriteShardInto(arguments.output, std::move(sequence),
                        {run, ParseShard(arguments.shard), arguments.force, arguments.run.quiet},
                        printer);
}

std::vector<Shard> ShardsToMerge(const ReconstructArguments& arguments, const ShardedRun& run,
                                 const Sequence& sequence) {
  if (arguments.shards.empty()) return {};
  return OpenShards(arguments.shards, IdentityOf(sequence, run));
}

// --depth is one more setting.
ConfigSources SourcesOf(const ReconstructArguments& arguments) {
  ConfigSources sources = Sources(arguments.config);
  if (!arguments.depth.empty()) sources.assignments.push_back("depth.use=" + arguments.depth);
  return sources;
}

void RequireDepth(const ReconstructArguments& arguments, const Sequence& sequence) {
  if (sequence.has_depth) return;
  const bool is_split = !arguments.shard.empty() || !arguments.shards.empty();
  if (is_split) {
    throw Error(ErrorKind::kUsage,
                "--shard and --merge split the segmentation of depth images, which are not there "
                "or not to be used; leave them out");
  }
  if (arguments.hybrid) {
    throw Error(ErrorKind::kUsage,
                "--hybrid makes solid parts from depth images, which are not there or not to be "
                "used; leave it out");
  }
}

int RunReconstruct(const ReconstructArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const Config config = ReadConfig(SourcesOf(arguments));
  const ShardedRun sharded = {config, arguments.colour_camera == "auto", arguments.track};
  RequireShardsPossible(arguments, config);
  LimitThreads(arguments.run);
  Sequence sequence =
      OpenSequence(arguments.sequence, arguments.track ? PoseUse::kIgnored : PoseUse::kIfGiven,
                   DepthUseOf(config.pipeline));
  RequireDepth(arguments, sequence);
  if (!arguments.shard.empty()) return RunShard(arguments, sharded, std::move(sequence));
  RequireInputStays(arguments);
  RequireRoom(arguments, sequence);
  std::vector<Shard> shards = ShardsToMerge(arguments, sharded, sequence);
  std::vector<fs::path> extras = {arguments.stages.folder, arguments.stages.volume};
  for (const Shard& shard : shards) extras.push_back(shard.file);
  const ResultFolder output(arguments.output, extras, arguments.force);
  ProgressPrinter printer = MakeProgressPrinter(arguments.run.quiet);
  const ResultRun run{config, sharded.fit_colour_camera, arguments.stages, arguments.run.quiet,
                      start,  arguments.hybrid,          std::move(shards)};
  return ReconstructInto(output, std::move(sequence), run, printer);
}

void AddShardOptions(CLI::App& command, ReconstructArguments& arguments) {
  command.add_option("--shard", arguments.shard,
                     "i/N, such as 2/4: do the part of the work that several machines can share, "
                     "for one of N parts of the scan, and write OUTPUT/shard_i_of_N.cfshard; one "
                     "that is there is not made again without --force");
  command
      .add_option("--merge", arguments.shards,
                  "The N files that --shard has written, or their folder: the same result as "
                  "without them, from the same scan and settings")
      ->expected(1, -1);
}

}  // namespace

void AddReconstructCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "reconstruct", "Turn an RGB-D sequence into a curve skeleton and a tube mesh");
  const auto arguments = std::make_shared<ReconstructArguments>();
  command
      ->add_option("SEQUENCE", arguments->sequence,
                   "The scan: a folder of images, or a recording such as scan.bag")
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "Folder for the result: report.html, skeleton.json, mesh.ply, preview.png, "
                   "report.json and others")
      ->required();
  command->add_flag("--force", arguments->force,
                    "Write into a folder that holds other files; these are kept");
  AddConfigArguments(*command, arguments->config);
  command->add_flag("--track", arguments->track,
                    "Find the camera poses by tracking (see track) even where the sequence has "
                    "some; without poses this is done anyway");
  command
      ->add_option("--depth", arguments->depth,
                   "What depth images are used for, short for --set depth.use=...; wires: curves "
                   "come from depth; background: surfaces and scale, curves come from colour; "
                   "none: nothing, curves come from colour and scale from the poses (for scans of "
                   "colour images and poses); auto (default): wires, or what shows them better")
      ->check(CLI::IsMember(DepthRoleNames()));
  command
      ->add_option("--colour-camera", arguments->colour_camera,
                   "auto: a colour camera fitted to the images where colour edges lie far from "
                   "depth edges; given: always that of the intrinsics")
      ->check(CLI::IsMember({"auto", "given"}))
      ->capture_default_str();
  command->add_flag(
      "--hybrid", arguments->hybrid,
      "Write hybrid.ply (m) and hybrid.stl (mm, for printing) as well: one watertight "
      "mesh of the wires and of the solid parts that they are attached to (a seat, a "
      "pot, a mug), without floor, walls and table");
  AddRunOptions(*command, arguments->run);
  command->add_option("--save-stages", arguments->stages.folder,
                      "Folder for the points and curves of every step, as PLY");
  command->add_option("--save-volume", arguments->stages.volume,
                      "Mesh file for the surface of large objects: .ply, .obj, .stl, .glb or .3mf");
  AddShardOptions(*command, *arguments);
  command->footer(
      "Example:\n  curvefusion reconstruct scan -o result\n"
      "  curvefusion reconstruct scan -o result --profile paper --set volume.voxel_size=0.01\n"
      "  curvefusion reconstruct scan -o result --track\n"
      "  curvefusion reconstruct scan -o result --hybrid\n"
      "  curvefusion reconstruct photos -o result --depth none\n"
      "  curvefusion reconstruct scan -o result --save-stages result/stages\n"
      "  curvefusion reconstruct scan -o shards --shard 1/2\n"
      "  curvefusion reconstruct scan -o shards --shard 2/2\n"
      "  curvefusion reconstruct scan -o result --merge shards");
  command->callback([arguments, &exit_code] { exit_code = RunReconstruct(*arguments); });
}

}  // namespace curvefusion
