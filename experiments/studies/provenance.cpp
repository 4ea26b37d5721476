#include "experiments/studies/provenance.h"

#include <unistd.h>

#include <fstream>
#include <thread>

#include "git_revision.h"

namespace curvefusion {

namespace {

std::string ProcessorModel() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

}  // namespace

Provenance ThisProgram() {
  const double pages = static_cast<double>(sysconf(_SC_PHYS_PAGES));
  const double page = static_cast<double>(sysconf(_SC_PAGE_SIZE));
  return {CURVEFUSION_VERSION, CURVEFUSION_REVISION, ProcessorModel(),
          static_cast<int>(std::thread::hardware_concurrency()), pages * page / 1e9};
}

std::string MethodVersion() { return CURVEFUSION_METHOD; }

}  // namespace curvefusion
