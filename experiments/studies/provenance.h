#pragma once

#include <string>

namespace curvefusion {

/// What measured something, and on what.
struct Provenance {
  std::string version;    ///< of the program
  std::string revision;   ///< git commit, with "-dirty-" and a hash of what was not committed
  std::string processor;  ///< model, as the kernel names it
  int cores = 0;
  double memory_gb = 0;  ///< of the machine, 1e9 bytes
};

/// Of this program on this machine. "unknown" where it was not built from a git repository or the
/// system does not tell.
Provenance ThisProgram();

/// A hash of the source code that decides curves and their figures: the same for two builds that
/// differ in other things only.
std::string MethodVersion();

}  // namespace curvefusion
