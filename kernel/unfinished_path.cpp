#include "kernel/unfinished_path.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <system_error>
#include <utility>
#include <vector>

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

// A thread may still put a file into a folder that is being removed: the next attempt takes it.
constexpr int kAttempts = 5;

struct Registry {
  std::mutex mutex;
  std::vector<fs::path> paths;
};

// Never destroyed: another thread may ask for it while the process ends.
Registry& Marked() {
  static auto* const registry = new Registry;
  return *registry;
}

}  // namespace

UnfinishedPath::UnfinishedPath(fs::path path) : path_(std::move(path)) {
  const fs::path absolute = fs::absolute(path_);
  const std::lock_guard<std::mutex> lock(Marked().mutex);
  Marked().paths.push_back(absolute);
}

UnfinishedPath::~UnfinishedPath() {
  std::error_code ignored;
  const fs::path absolute = fs::absolute(path_, ignored);
  const std::lock_guard<std::mutex> lock(Marked().mutex);
  std::vector<fs::path>& paths = Marked().paths;
  const auto found = std::find(paths.begin(), paths.end(), absolute);
  if (found != paths.end()) paths.erase(found);
}

void RemoveUnfinishedPaths() noexcept {
  try {
    const std::lock_guard<std::mutex> lock(Marked().mutex);
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      std::error_code ignored;
      for (const fs::path& path : Marked().paths) fs::remove_all(path, ignored);
    }
  } catch (const std::exception&) {  // out of memory: what is left stays
    return;
  }
}

}  // namespace curvefusion
