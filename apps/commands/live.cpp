
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>

#include "apps/commands/command.h"
#include "apps/commands/config_arguments.h"
#include "apps/interrupt.h"
#include "apps/live/live_capture.h"
#include "apps/live/live_line.h"
#include "apps/live/live_server.h"
#include "apps/live/live_source.h"
#include "apps/output_guard.h"
#include "apps/result_run.h"
#include "kernel/error.h"
#include "kernel/free_space.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

constexpr int kUsualPort = 8700;
constexpr double kUsualIdle = 10;  // seconds: hands that change their hold take a few
// What a live run and its result write: those of reconstruct and snapshots of the same size.
constexpr std::uintmax_t kFiles = 24u << 20;
constexpr const char* kScanFolder = "scan";
constexpr std::chrono::seconds kFarewell(2);  // a page asks twice a second

struct LiveArguments {
  fs::path source;
  fs::path output;
  ConfigArguments config;
  double rate = 0;
  bool follow = false;
  bool is_stream = false;
  double idle = kUsualIdle;
  bool track = false;
  bool serve = false;
  int port = kUsualPort;
  bool force = false;
  RunOptions run;
};

const BestOptions& BestOf(const Config& config) {
  const auto* options = std::get_if<BestOptions>(&config.pipeline);
  if (options == nullptr) {
    throw Error(ErrorKind::kUsage,
                "live shows what the best profile finds: leave out --profile paper, and give the "
                "scan to reconstruct afterwards");
  }
  if (options->depth.use == DepthRole::kNone) {
    throw Error(ErrorKind::kUsage,
                "live shows what depth images tell: depth.use=none is for reconstruct");
  }
  return *options;
}

PoseUse PosesFor(const LiveArguments& arguments) {
  return arguments.track ? PoseUse::kIgnored : PoseUse::kIfGiven;
}

// A camera that tracks itself has made the folder of its poses before the first frame.
bool WritesPoses(const LiveArguments& arguments) {
  return !arguments.track && fs::is_directory(arguments.source / "pose");
}

// A stream becomes a folder in the output, since in the end all frames are reconstructed.
void PrepareStream(LiveArguments& arguments) {
  if (arguments.follow || arguments.rate != 0) {
    throw Error(ErrorKind::kUsage,
                "live -: frames are taken as they come on standard input: leave out --follow, "
                "--idle and --rate");
  }
  if (isatty(STDIN_FILENO) != 0) {
    throw Error(ErrorKind::kUsage,
                "live -: standard input is a terminal: send a tar archive to it, as in "
                "'tar -C scan -c intrinsics.json pose color depth | curvefusion live - -o result'");
  }
  arguments.is_stream = true;
  arguments.source = arguments.output / kScanFolder;
  if (fs::exists(arguments.source)) {
    throw Error(ErrorKind::kUsage,
                fmt::format("{}: holds the frames of another run: name another folder by -o, or "
                            "move this one",
                            arguments.source.string()));
  }
}

std::unique_ptr<LiveSource> OpenSource(const LiveArguments& arguments) {
  if (arguments.is_stream) {
    fs::create_directory(arguments.source);
    return ReceiveFolder(arguments.source, !arguments.track);
  }
  if (!arguments.follow) {
    return ReplayOf(OpenSequence(arguments.source, PosesFor(arguments)), arguments.rate);
  }
  if (!fs::is_directory(arguments.source)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: is no folder; make it, with its folder pose/ "
                            "where the camera gives poses, before live starts",
                            arguments.source.string()));
  }
  return FollowFolder(arguments.source, WritesPoses(arguments), arguments.idle);
}

// All frames of the folder, those that were dropped as well; up to the last that came where the
// user has ended the capture.
Sequence Recorded(const LiveArguments& arguments, const CaptureEnd& end) {
  if (end.last_arrived.empty()) {
    throw Error(end.by_user ? ErrorKind::kInterrupted : ErrorKind::kBadInput,
                fmt::format("{}: no frame has come, so there is nothing to reconstruct{}",
                            arguments.source.string(),
                            arguments.is_stream ? "; frames without poses need --track" : ""));
  }
  Sequence sequence = OpenSequence(arguments.source, PosesFor(arguments));
  if (!end.by_user) return sequence;
  const auto last =
      std::find_if(sequence.frames.begin(), sequence.frames.end(),
                   [&](const SequenceFrame& frame) { return frame.name == end.last_arrived; });
  if (last != sequence.frames.end()) sequence.frames.erase(last + 1, sequence.frames.end());
  return sequence;
}

CaptureEnd Capture(const LiveArguments& arguments, const BestOptions& options, LiveBoard& board) {
  const std::unique_ptr<LiveSource> source = OpenSource(arguments);
  LiveLinePrinter printer(arguments.run.quiet);
  const CaptureInterrupt interrupt;
  const LiveCapture capture = {options, arguments.output,
                               [&interrupt] { return interrupt.requested(); },
                               [&](double now) { printer.Show(board.state(), now); }};
  const CaptureEnd end = CaptureLive(*source, capture, board);
  printer.Finish(board.state());
  return end;
}

void SetPhase(LivePhase phase, const fs::path& folder, LiveBoard& board) {
  board.Update([&](LiveState& state) { state.phase = phase; });
  WriteState(board, folder);
}

int RunLive(LiveArguments arguments) {
  const auto start = std::chrono::steady_clock::now();
  const Config config = ReadConfig(Sources(arguments.config));
  const BestOptions& options = BestOf(config);
  LimitThreads(arguments.run);
  if (arguments.source == "-") {
    PrepareStream(arguments);
  } else {
    RequireOutside(arguments.source, arguments.output);
  }
  RequireApart({arguments.config.file}, arguments.output / "config.toml");
  RequireFreeSpace(arguments.output, kFiles);
  const ResultFolder output(arguments.output,
                            {arguments.output / kSnapshotFile, arguments.output / kStateFile},
                            arguments.force);
  LiveBoard board;
  std::optional<LiveServer> server;
  if (arguments.serve) {
    server.emplace(arguments.port, board);
    fmt::print("Open {} in a browser of this machine\n", server->address());
    std::fflush(stdout);
  }
  const CaptureEnd end = Capture(arguments, options, board);
  SetPhase(LivePhase::kReconstructing, arguments.output, board);
  ProgressPrinter printer = MakeProgressPrinter(arguments.run.quiet);
  const ResultRun run{config, true, {}, arguments.run.quiet, start};
  const int exit_code = ReconstructInto(output, Recorded(arguments, end), run, printer);
  SetPhase(LivePhase::kDone, arguments.output, board);
  if (server && server->IsWatched()) std::this_thread::sleep_for(kFarewell);
  return exit_code;
}

void AddSourceOptions(CLI::App& command, LiveArguments& arguments) {
  const CLI::Option* rate =
      command
          .add_option("--rate", arguments.rate,
                      "Frames per second of a replay; otherwise by the time stamps, or 30 without "
                      "any")
          ->default_str("")
          ->check(CLI::Range(0.1, 1000.0));
  CLI::Option* follow = command.add_flag(
      "--follow", arguments.follow,
      "SOURCE is a folder that a camera writes: frames are taken as they appear in color/, depth/ "
      "and pose/, until there is a file named end, or none has come for some time");
  follow->excludes(const_cast<CLI::Option*>(rate));
  command
      .add_option("--idle", arguments.idle,
                  "With --follow: seconds without a new frame after which the capture ends")
      ->check(CLI::Range(0.1, 86400.0))
      ->needs(follow)
      ->capture_default_str();
  command.add_flag("--track", arguments.track,
                   "Find the camera poses by tracking even where the source has some; without "
                   "poses this is done anyway");
}

void AddServeOptions(CLI::App& command, LiveArguments& arguments) {
  CLI::Option* serve = command.add_flag("--serve", arguments.serve,
                                        "Show the curves in a web page, for this machine only");
  command.add_option("--port", arguments.port, "Port of --serve; 0: any that is free")
      ->check(CLI::Range(0, 65535))
      ->needs(serve)
      ->capture_default_str();
}

}  // namespace

void AddLiveCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "live", "Reconstruct while scanning: show what is found and what is missing");
  const auto arguments = std::make_shared<LiveArguments>();
  command
      ->add_option("SOURCE", arguments->source,
                   "Sequence (folder or recording) to replay; with --follow a folder that grows; "
                   "-: a tar archive of such a folder on standard input, kept as OUTPUT/scan")
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "Folder for snapshot.json and state.json while the scan goes on, and in the end "
                   "for what reconstruct writes")
      ->required();
  AddSourceOptions(*command, *arguments);
  AddServeOptions(*command, *arguments);
  command->add_flag("--force", arguments->force,
                    "Write into a folder that holds other files; these are kept");
  AddConfigArguments(*command, arguments->config);
  AddRunOptions(*command, arguments->run);
  command->footer(
      "Ctrl-C ends the capture; what was captured is then reconstructed. A second one ends "
      "the program.\n"
      "Example:\n  curvefusion live scan -o result --serve\n"
      "  curvefusion live camera_folder -o result --follow --idle 20 --serve --port 9000\n"
      "  curvefusion live scan -o result --rate 15\n"
      "  camera_program | curvefusion live - -o result");
  command->callback([arguments, &exit_code] { exit_code = RunLive(*arguments); });
}

}  // namespace curvefusion
