#include "apps/interrupt.h"

#include <csignal>

#include "kernel/error.h"

namespace curvefusion {

namespace {

// A signal handler can reach nothing but a global of this type.
volatile std::sig_atomic_t interrupted = 0;

void SetInterrupted(int) { interrupted = 1; }

}  // namespace

void CatchInterrupts() {
  struct sigaction action = {};
  action.sa_handler = SetInterrupted;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void ThrowIfInterrupted() {
  if (interrupted != 0) {
    throw Error(ErrorKind::kInterrupted, "interrupted; no result was written");
  }
}

}  // namespace curvefusion
