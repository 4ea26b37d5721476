#include "kernel/partial_folder.h"

#include <string>
#include <system_error>
#include <utility>

#include "kernel/error.h"
#include "kernel/partial_name.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

void ThrowIf(const std::error_code& failure, const fs::path& path) {
  if (!failure) return;
  throw Error(ErrorKind::kResource,
              path.string() + ": cannot be written (" + failure.message() + ")");
}

}  // namespace

PartialFolder::PartialFolder(fs::path final_path)
    : final_path_(std::move(final_path)), unfinished_(PartialFolderPath(final_path_)) {
  std::error_code failure;
  RemoveStalePartials(final_path_);
  fs::remove_all(path(), failure);
  fs::create_directories(path(), failure);
  ThrowIf(failure, final_path_);
}

PartialFolder::~PartialFolder() {
  std::error_code ignored;
  fs::remove_all(path(), ignored);
}

void PartialFolder::Finish() {
  std::error_code failure;
  fs::remove_all(final_path_, failure);
  ThrowIf(failure, final_path_);
  fs::rename(path(), final_path_, failure);
  ThrowIf(failure, final_path_);
}

}  // namespace curvefusion
