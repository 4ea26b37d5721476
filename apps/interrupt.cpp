#include "apps/interrupt.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <string_view>
#include <system_error>
#include <thread>

#include "kernel/cancellation.h"
#include "kernel/error.h"
#include "kernel/unfinished_path.h"

namespace curvefusion {

namespace {

// Half a second is what a user is promised; removing what was begun needs some of it.
constexpr std::chrono::milliseconds kPatience(300);
constexpr std::string_view kMessage = "curvefusion: interrupted\n";

// A signal handler can reach nothing but globals.
std::array<int, 2> signal_pipe = {-1, -1};

void OnSignal(int) {
  const int saved_errno = errno;
  RequestCancellation();
  const char byte = 0;
  [[maybe_unused]] const ssize_t written = write(signal_pipe[1], &byte, 1);
  errno = saved_errno;
}

// Ends the process where the run does not end by itself soon enough, inside a long call of a
// library or a read of a slow device, say.
void EndAfterPatience() {
  char byte = 0;
  while (read(signal_pipe[0], &byte, 1) < 0) {
    if (errno != EINTR) return;
  }
  std::this_thread::sleep_for(kPatience);
  RemoveUnfinishedPaths();
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kMessage.data(), kMessage.size());
  _exit(ExitCode(ErrorKind::kInterrupted));
}

// Where no pipe or thread is to be had, runs end where they look at the flag.
void StartWatching() {
  if (pipe2(signal_pipe.data(), O_CLOEXEC) != 0) return;
  try {
    std::thread(EndAfterPatience).detach();
  } catch (const std::system_error&) {
    return;
  }
}

// What a signal handler may call, too.
void HandleOnce(int signal, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

static_assert(std::atomic<bool>::is_always_lock_free);
std::atomic<bool> capture_end_requested{false};

void OnCaptureSignal(int signal) {
  capture_end_requested = true;
  HandleOnce(signal, OnSignal);
}

}  // namespace

void CatchInterrupts() {
  StartWatching();
  HandleOnce(SIGINT, OnSignal);
  HandleOnce(SIGTERM, OnSignal);
}

CaptureInterrupt::CaptureInterrupt() {
  capture_end_requested = false;
  HandleOnce(SIGINT, OnCaptureSignal);
}

CaptureInterrupt::~CaptureInterrupt() { HandleOnce(SIGINT, OnSignal); }

bool CaptureInterrupt::requested() const { return capture_end_requested; }

}  // namespace curvefusion
