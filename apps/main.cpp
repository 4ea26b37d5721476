#include <fmt/format.h>
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "apps/command_line.h"
#include "apps/failure.h"
#include "apps/interrupt.h"
#include "kernel/error.h"
#include "kernel/options.h"

namespace curvefusion {

namespace {

constexpr int kMegabyte = 1 << 20;

// Memory set aside for when operator new finds none. The first lack is bridged by one half, as it
// may happen in a destructor, which must not throw (those of JSON values take memory); the other
// half is there for the destructors that run once std::bad_alloc is thrown. A half is, as chosen,
// many times what a destructor of JSON values takes, 16 bytes for each element of its largest
// array, and nothing beside what a run needs. A new handler can reach nothing but globals.
std::atomic<void*> bridge{nullptr};
std::atomic<void*> rest{nullptr};

void UseReserve() {
  if (void* const block = bridge.exchange(nullptr)) {
    std::free(block);
    return;  // operator new tries again
  }
  std::free(rest.exchange(nullptr));
  throw std::bad_alloc();
}

// Throws std::bad_alloc where there is not even so much.
void SetMemoryAside() {
  bridge = std::malloc(kMegabyte);
  rest = std::malloc(kMegabyte);
  if (bridge == nullptr || rest == nullptr) throw std::bad_alloc();
  std::set_new_handler(UseReserve);
}

// CLI11 says of a mistyped command only that one is required.
void CheckCommandName(const CLI::App& app, const std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments.front().starts_with('-')) return;
  const std::string& name = arguments.front();
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  throw Error(ErrorKind::kUsage,
              fmt::format("there is no command {}; did you mean {}? `curvefusion --help` lists all",
                          name, NearestName(name, names)));
}

// `help` and `help COMMAND` are what `--help` and `COMMAND --help` are.
std::vector<std::string> Arguments(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.empty() || arguments.front() != "help") return arguments;
  if (arguments.size() == 1 || arguments[1] == "help") return {"--help"};
  return {arguments[1], "--help"};
}

int Parse(std::vector<std::string> arguments) {
  CLI::App app;
  int exit_code = 0;
  AddCommandLine(app, exit_code);
  CheckCommandName(app, arguments);
  try {
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
    app.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : ExitCode(ErrorKind::kUsage);
  }
  return exit_code;
}

// What a step frees the next one asks for again: memory that is kept need not be cleared anew by
// the system, page by page.
void KeepFreedMemory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 * kMegabyte);
  mallopt(M_TRIM_THRESHOLD, 128 * kMegabyte);
#endif
}

int Run(int argc, char** argv) {
  try {
    SetMemoryAside();
    CatchInterrupts();
    IgnoreWriteSignals();
    KeepFreedMemory();
    return FlushedOutput(Parse(Arguments(argc, argv)));
  } catch (...) {
    return ReportFailure();
  }
}

}  // namespace

}  // namespace curvefusion

int main(int argc, char** argv) { return curvefusion::Run(argc, argv); }
