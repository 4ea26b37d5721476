#pragma once

/// What calls throw (Error, ErrorKind, ExitCode), how they tell their progress, and how all work of
/// the process is ended from outside (RequestCancellation).

#include "kernel/cancellation.h"
#include "kernel/error.h"
#include "kernel/progress.h"
