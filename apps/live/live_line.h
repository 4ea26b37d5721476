#pragma once

#include <string>

#include "apps/live/live_board.h"

namespace curvefusion {

/// "12.3 s, 367 frames, 30.0/s, 0 dropped, snapshot 0.6 s behind, 2.31 m of curve, 4 free ends".
std::string LiveLine(const LiveState& state);

/// Shows how a live run goes on standard error: on a terminal one line that is overwritten, else a
/// line every few seconds; or nothing.
class LiveLinePrinter {
 public:
  explicit LiveLinePrinter(bool quiet);
  /// `now` in seconds of any clock.
  void Show(const LiveState& state, double now);
  /// Prints the last line whole, so that other output can follow.
  void Finish(const LiveState& state);

 private:
  bool quiet_;
  bool is_terminal_;
  double next_ = 0;
};

}  // namespace curvefusion
