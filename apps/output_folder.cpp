#include "apps/output_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

#include "kernel/error.h"
#include "kernel/partial_name.h"

namespace curvefusion {

namespace fs = std::filesystem;

void MakeOutputFolder(const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (!failure && !fs::is_directory(folder))
    failure = std::make_error_code(std::errc::not_a_directory);
  if (!failure && access(folder.c_str(), W_OK | X_OK) != 0) {
    failure = std::error_code(errno, std::generic_category());
  }
  if (failure) {
    throw Error(ErrorKind::kResource, fmt::format("{}: results cannot be written there ({})",
                                                  folder.string(), failure.message()));
  }
}

void MakeFolderOf(const fs::path& file) {
  if (file.empty()) return;
  std::error_code failure;
  const fs::file_status status = fs::status(file, failure);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw Error(ErrorKind::kResource,
                fmt::format("{}: is {}; name a file to write", file.string(),
                            fs::is_directory(status) ? "a folder" : "no regular file"));
  }
  if (file.has_parent_path()) MakeOutputFolder(file.parent_path());
  RemoveStalePartials(file);
}

}  // namespace curvefusion
