#include "kernel/peak_memory.h"

#include <sys/resource.h>

namespace curvefusion {

int64_t PeakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return int64_t{usage.ru_maxrss} * 1024;  // Linux counts it in KiB
}

}  // namespace curvefusion
