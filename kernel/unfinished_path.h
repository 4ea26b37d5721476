#pragma once

#include <filesystem>

namespace curvefusion {

/// Marks a file or folder as unfinished while it lives: what would remain of it where the process
/// has to end without unwinding its stack.
class UnfinishedPath {
 public:
  explicit UnfinishedPath(std::filesystem::path path);
  ~UnfinishedPath();
  UnfinishedPath(const UnfinishedPath&) = delete;
  UnfinishedPath& operator=(const UnfinishedPath&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Removes all files and folders that are marked at this moment, whoever still writes to them. For
/// the end of a process.
void RemoveUnfinishedPaths() noexcept;

}  // namespace curvefusion
