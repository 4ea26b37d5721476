#pragma once

#include <atomic>

namespace curvefusion {

namespace internal {
extern std::atomic<bool> cancellation_requested;
[[noreturn]] void ThrowCancelled();
}  // namespace internal

/// Asks all work of this process to end soon: parallel loops and long algorithms then throw. A
/// library user who never calls it is never cancelled. Signal handlers may call it.
void RequestCancellation() noexcept;

/// Takes the request back, so that work may begin anew.
void ResetCancellation() noexcept;

/// Throws Error(kInterrupted) once cancellation has been requested. Long serial loops call it;
/// loops of kernel/parallel.h do so between their chunks. Costs one relaxed load.
inline void ThrowIfCancelled() {
  if (internal::cancellation_requested.load(std::memory_order_relaxed)) internal::ThrowCancelled();
}

}  // namespace curvefusion
