#pragma once

#include <stdexcept>
#include <string>

namespace curvefusion {

/// What went wrong, as far as the caller can act on it; the command line maps it to an exit code.
enum class ErrorKind {
  kUsage,        ///< an option or config value that cannot be: exit code 2
  kBadInput,     ///< a file or a scan that cannot be used: exit code 3
  kResource,     ///< out of memory, disk or another resource: exit code 5
  kBusy,         ///< another run writes to the same place: exit code 75 (EX_TEMPFAIL)
  kInterrupted,  ///< the user asked to stop: exit code 130
};

/// The one exception this project throws for conditions a user can mend.
/// The message names the file, the frame, the value, the limit and what to do.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

/// Exit code of the command line for an error of this kind.
int ExitCode(ErrorKind kind);

}  // namespace curvefusion
