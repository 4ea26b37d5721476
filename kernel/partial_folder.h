#pragma once

#include <filesystem>

#include "kernel/unfinished_path.h"

namespace curvefusion {

/// A folder that is filled under a temporary name and gets its final one only when it is complete;
/// otherwise it disappears, and whatever lay under the final name stays.
class PartialFolder {
 public:
  /// Makes the folder and those above it, and removes what killed processes have left of it. Throws
  /// Error(kResource) where that is impossible.
  explicit PartialFolder(std::filesystem::path final_path);
  ~PartialFolder();
  PartialFolder(const PartialFolder&) = delete;
  PartialFolder& operator=(const PartialFolder&) = delete;

  const std::filesystem::path& path() const { return unfinished_.path(); }

  /// Replaces what lies under the final name. Throws Error(kResource) where that is impossible.
  void Finish();

 private:
  std::filesystem::path final_path_;
  UnfinishedPath unfinished_;
};

}  // namespace curvefusion
