#pragma once

namespace curvefusion {

/// From now on SIGINT and SIGTERM only set a flag, so that a run ends where it leaves nothing
/// half-written. A second signal ends the program at once.
void CatchInterrupts();

/// Throws Error(kInterrupted) once a signal has arrived. Long steps call it through their progress.
void ThrowIfInterrupted();

}  // namespace curvefusion
