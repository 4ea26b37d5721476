#pragma once

#include <cstdint>

namespace curvefusion {

/// The most memory this process has held so far, in bytes (resident set).
int64_t PeakMemory();

}  // namespace curvefusion
