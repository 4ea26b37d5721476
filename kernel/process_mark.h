#pragma once

#include <string>

namespace curvefusion {

/// What tells a process from those of other machines, containers and boots.
struct ProcessMark {
  int pid = 0;
  std::string host;  ///< its name
  std::string boot;  ///< of its kernel; containers of one machine share it
};

ProcessMark ThisProcess();

/// Eight hexadecimal digits that are the same for all processes whose numbers this one can look up:
/// those of this host and this container.
std::string ProcessSpace();

/// Whether no process of this space has the number. One that was taken over by another process
/// counts as there.
bool IsGone(int pid);

}  // namespace curvefusion
