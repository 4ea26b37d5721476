#include "apps/live/live_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <iostream>

namespace curvefusion {

namespace {

constexpr double kTerminalStep = 0.2;  // seconds: faster cannot be read
constexpr double kLineStep = 5;

}  // namespace

std::string LiveLine(const LiveState& state) {
  if (state.phase == LivePhase::kWaiting) return "waiting for the first frame";
  const SnapshotFigures& snapshot = state.snapshot;
  const std::string lost = state.lost > 0 ? fmt::format(", {} lost", state.lost) : "";
  const std::string curves =
      snapshot.number == 0
          ? "no snapshot yet"
          : fmt::format("snapshot {:.1f} s behind, {:.2f} m of curve, {} free ends",
                        snapshot.seconds_behind, snapshot.length, snapshot.free_ends);
  return fmt::format("{:.1f} s, {} frames, {:.1f}/s, {} dropped{}, {}", state.seconds,
                     state.arrived, state.frame_rate, state.dropped, lost, curves);
}

LiveLinePrinter::LiveLinePrinter(bool quiet)
    : quiet_(quiet), is_terminal_(isatty(STDERR_FILENO) != 0) {}

void LiveLinePrinter::Show(const LiveState& state, double now) {
  if (quiet_ || now < next_) return;
  next_ = now + (is_terminal_ ? kTerminalStep : kLineStep);
  std::cerr << (is_terminal_ ? "\r\033[K" : "") << LiveLine(state) << (is_terminal_ ? "" : "\n")
            << std::flush;
}

void LiveLinePrinter::Finish(const LiveState& state) {
  if (quiet_) return;
  std::cerr << (is_terminal_ ? "\r\033[K" : "") << LiveLine(state) << '\n';
}

}  // namespace curvefusion
