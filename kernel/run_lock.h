#pragma once

#include <filesystem>
#include <optional>

#include "kernel/unfinished_path.h"

namespace curvefusion {

/// Keeps other runs out of a place while it lives, by a file with an advisory lock (flock) that
/// tells who holds it. The file disappears at the end. One that a killed run has left is taken
/// over: its lock went with its process.
class RunLock {
 public:
  /// `place` names in messages what is locked. Throws Error(kBusy) where another run holds the
  /// lock, or where a run of another machine has left the file, whose end cannot be seen from here;
  /// Error(kResource) where the file cannot be made.
  RunLock(std::filesystem::path file, const std::filesystem::path& place);
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
  std::optional<UnfinishedPath> unfinished_;  // an end without unwinding removes the file, too
};

}  // namespace curvefusion
