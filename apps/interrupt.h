#pragma once

namespace curvefusion {

/// From now on SIGINT and SIGTERM cancel what runs (kernel/cancellation.h), so that it ends where
/// it leaves nothing half-written. What has not ended after 0.3 s is ended: temporary files and
/// folders are removed, and the process exits with the code of an interruption. A second signal
/// ends the program at once.
void CatchInterrupts();

}  // namespace curvefusion
