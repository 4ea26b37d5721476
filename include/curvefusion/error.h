#pragma once

/// @file
/// What all calls have in common. Link `curvefusion::kernel`.
/// - Error is thrown for what a user can mend; its kind() is an ErrorKind, its what() names file or
///   value and remedy. Lack of memory is std::bad_alloc.
/// - Progress is called by long calls with stage, done and total; NoProgress ignores it. An
///   exception from it ends the call.
/// - RequestCancellation, also from a signal handler, ends all work of the process soon with
///   Error(kInterrupted), until ResetCancellation.

#include "kernel/cancellation.h"
#include "kernel/error.h"
#include "kernel/progress.h"
