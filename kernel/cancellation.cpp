#include "kernel/cancellation.h"

#include "kernel/error.h"

namespace curvefusion {

namespace internal {

// Signal handlers write it.
static_assert(std::atomic<bool>::is_always_lock_free);
std::atomic<bool> cancellation_requested{false};

void ThrowCancelled() {
  throw Error(ErrorKind::kInterrupted, "interrupted; no result was written");
}

}  // namespace internal

void RequestCancellation() noexcept { internal::cancellation_requested = true; }

void ResetCancellation() noexcept { internal::cancellation_requested = false; }

}  // namespace curvefusion
