#pragma once

namespace curvefusion {

/// From now on SIGINT and SIGTERM cancel what runs (kernel/cancellation.h), so that it ends where
/// it leaves nothing half-written. What has not ended after 0.3 s is ended: temporary files and
/// folders are removed, and the process exits with the code of an interruption. A second signal
/// ends the program at once.
void CatchInterrupts();

/// While it lives, the first SIGINT (Ctrl-C) only asks for the end of a capture; a second one is
/// what the first is otherwise. SIGTERM stays as it is. One at a time, after CatchInterrupts.
class CaptureInterrupt {
 public:
  CaptureInterrupt();
  ~CaptureInterrupt();
  CaptureInterrupt(const CaptureInterrupt&) = delete;
  CaptureInterrupt& operator=(const CaptureInterrupt&) = delete;

  bool requested() const;
};

}  // namespace curvefusion
