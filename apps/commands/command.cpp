#include "apps/commands/command.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

#include "kernel/cancellation.h"
#include "kernel/parallel.h"

namespace curvefusion {

void AddRunOptions(CLI::App& command, RunOptions& options) {
  command.add_option("--threads", options.threads, "Threads to use; 0 = all cores")
      ->check(CLI::Range(0, 1024));
  command.add_flag("--quiet", options.quiet, "Print nothing but errors");
}

CLI::Validator PositiveNumber() {
  return CLI::Validator(
      [](const std::string& text) {
        double number = 0;
        const bool is_positive =
            CLI::detail::lexical_cast(text, number) && number > 0 && std::isfinite(number);
        return is_positive ? std::string()
                           : text + " is no positive number; write it without a unit, such as 2";
      },
      "POSITIVE");
}

void LimitThreads(const RunOptions& options) {
  static ThreadLimit* limit = nullptr;  // never destroyed: interrupted steps may outlive main
  if (limit == nullptr) limit = new ThreadLimit(options.threads);
}

Progress InterruptibleProgress(ProgressPrinter& printer) {
  return [&printer](std::string_view stage, int64_t done, int64_t total) {
    ThrowIfCancelled();
    printer.Report(std::string(stage), done, total);
  };
}

}  // namespace curvefusion
