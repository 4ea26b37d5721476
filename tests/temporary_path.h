#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

namespace curvefusion {

/// A path for a test's own files, not shared with tests that run at the same time in other
/// processes.
inline std::filesystem::path TemporaryPath(const std::string& name) {
  return std::filesystem::temp_directory_path() /
         ("curvefusion_" + name + "_" + std::to_string(::getpid()));
}

/// A folder that is empty at first and gone with the object, of a name that none before it had.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& name = "test")
      : path_(TemporaryPath(name + "_" + std::to_string(count_++))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  operator const std::filesystem::path&() const { return path_; }
  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

 private:
  static inline int count_ = 0;
  std::filesystem::path path_;
};

}  // namespace curvefusion
