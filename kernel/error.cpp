#include "kernel/error.h"

namespace curvefusion {

int ExitCode(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kUsage:
      return 2;
    case ErrorKind::kBadInput:
      return 3;
    case ErrorKind::kResource:
      return 5;
    case ErrorKind::kBusy:
      return 75;
    case ErrorKind::kInterrupted:
      return 130;
  }
  return 1;
}

}  // namespace curvefusion
