#include "apps/demo_scan.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/commands/command.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

struct DemoScanArguments {
  std::filesystem::path output;
  DemoScanOptions scan;
  RunOptions run;
};

int RunDemoScan(const DemoScanArguments& arguments) {
  ProgressPrinter printer = MakeProgressPrinter(arguments.run.quiet);
  const ThreadLimit limit(arguments.run.threads);
  WriteDemoScan(arguments.output, arguments.scan, InterruptibleProgress(printer));
  printer.Finish();
  if (!arguments.run.quiet) {
    fmt::print("Made a scan of a wire cube with a ring (5 mm wire, 12 junctions): {}\n",
               arguments.output.string());
  }
  return 0;
}

}  // namespace

void AddDemoScanCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "demo-scan", "Make up a scan of a wire frame, to try everything without a camera");
  const auto arguments = std::make_shared<DemoScanArguments>();
  command->add_option("-o,--output", arguments->output, "Folder for the sequence")->required();
  command->add_option("--frames", arguments->scan.frame_count, "Number of frames")
      ->check(CLI::Range(1, 10000));
  AddRunOptions(*command, arguments->run);
  command->footer(
      "Example:\n  curvefusion demo-scan -o demo/scan\n"
      "  curvefusion reconstruct demo/scan -o demo/result");
  command->callback([arguments, &exit_code] { exit_code = RunDemoScan(*arguments); });
}

}  // namespace curvefusion
