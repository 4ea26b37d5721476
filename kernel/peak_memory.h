#pragma once

#include <cstdint>

namespace curvefusion {

/// The most memory this process has held so far, in bytes (resident set).
int64_t PeakMemory();

/// From now on PeakMemory tells of what follows: it starts anew from what is held now. Does nothing
/// where the system forbids it.
void ResetPeakMemory();

}  // namespace curvefusion
