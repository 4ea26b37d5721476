#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/commands/command.h"
#include "apps/output_guard.h"
#include "capture/unpack_videos.h"

namespace curvefusion {

namespace {

struct UnpackArguments {
  std::filesystem::path scan;
  std::filesystem::path output;
  RunOptions run;
};

int RunUnpack(const UnpackArguments& arguments) {
  LimitThreads(arguments.run);
  RequireOutside(arguments.scan, arguments.output);
  ProgressPrinter printer = MakeProgressPrinter(arguments.run.quiet);
  const UnpackedVideos unpacked =
      UnpackVideos(arguments.scan, arguments.output, InterruptibleProgress(printer));
  printer.Finish();
  if (arguments.run.quiet) return 0;
  for (const auto& [name, images] : unpacked.images) {
    fmt::print("{:<12} {} images\n", name, images);
  }
  if (unpacked.untrusted_share > 0) {
    fmt::print("confidence   {:.1f} % of the measured depth left out\n",
               100 * unpacked.untrusted_share);
  }
  fmt::print("wrote {0}; look at it with: curvefusion check {0}\n", arguments.output.string());
  return 0;
}

}  // namespace

void AddUnpackCommand(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("unpack", "Write a scan whose images are videos as a folder of images");
  const auto arguments = std::make_shared<UnpackArguments>();
  command
      ->add_option("SCAN", arguments->scan,
                   "Folder with rgb.mp4 (Stray Scanner), or with color.mkv and depth.mkv; needs "
                   "the program ffmpeg")
      ->required();
  command->add_option("-o,--output", arguments->output, "Folder to write")->required();
  AddRunOptions(*command, arguments->run);
  command->footer(
      "Depth of low confidence (confidence/) is left out. Examples:\n"
      "  curvefusion unpack scan -o scan_images\n"
      "  curvefusion reconstruct scan_images -o result");
  command->callback([arguments, &exit_code] { exit_code = RunUnpack(*arguments); });
}

}  // namespace curvefusion
