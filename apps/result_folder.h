#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "kernel/run_lock.h"

namespace curvefusion {

/// The names of all files that a reconstruction may leave, report.json, the mark of a complete
/// result, last.
const std::vector<std::string>& ResultNames();

/// The folder that takes the files of a reconstruction, for one run at a time. They appear
/// together, report.json last, in place of those of an earlier run; other files stay as they are.
class ResultFolder {
 public:
  using Writer = std::function<void(const std::filesystem::path& temporary)>;

  /// Makes the folder, or takes one that is empty or holds an earlier result; `extras` may lie in
  /// it as well. With `force` it may hold anything but files of the names that will be written.
  /// Throws Error(kUsage) for other folders, Error(kBusy) where another run writes there,
  /// Error(kResource) where nothing can be written.
  ResultFolder(std::filesystem::path folder, const std::vector<std::filesystem::path>& extras,
               bool force);

  const std::filesystem::path& path() const { return folder_; }

  /// Replaces the files of an earlier run by what `write` makes in a temporary folder.
  void Replace(const Writer& write) const;

  /// The name that report.json, report.html or config.toml of a run that found nothing gets: an
  /// earlier result stays whole.
  std::string NothingFoundName(const std::string& name) const;

  /// Adds these three, all made by `write`, and what else it makes where there is no earlier
  /// result.
  void AddNothingFound(const Writer& write) const;

 private:
  bool HoldsSkeleton() const;

  std::filesystem::path folder_;
  std::optional<RunLock> lock_;
};

}  // namespace curvefusion
