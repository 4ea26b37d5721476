#include "kernel/atomic_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <system_error>

#include "kernel/error.h"
#include "kernel/partial_folder.h"
#include "kernel/unfinished_path.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

Error CannotBeWritten(const fs::path& path, const std::string& reason) {
  return {ErrorKind::kResource, fmt::format("{}: cannot be written ({})", path.string(), reason)};
}

// Without a slash at its end, which would hide its name.
fs::path NamedFolder(const fs::path& folder) {
  const fs::path path = fs::absolute(folder).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

void CheckIsFree(const fs::path& folder) {
  std::error_code failure;
  if (!fs::exists(folder, failure)) return;
  if (fs::is_directory(folder, failure) && fs::is_empty(folder, failure)) return;
  throw Error(
      ErrorKind::kUsage,
      fmt::format("{}: is there already; name another folder or remove it", folder.string()));
}

}  // namespace

void WriteFileAtomically(const fs::path& path,
                         const std::function<void(const fs::path& temporary)>& write) {
  fs::path temporary = path;
  temporary.replace_filename(
      fmt::format("{}.partial-{}{}", path.stem().string(), ::getpid(), path.extension().string()));
  const UnfinishedPath marked(temporary);
  std::error_code failure;
  try {
    write(temporary);
    fs::rename(temporary, path, failure);
  } catch (...) {
    fs::remove(temporary, failure);
    throw;
  }
  if (failure) {
    const std::string reason = failure.message();
    fs::remove(temporary, failure);
    throw CannotBeWritten(path, reason);
  }
}

void WriteStreamAtomically(const fs::path& path,
                           const std::function<void(std::ostream& stream)>& write) {
  WriteFileAtomically(path, [&](const fs::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    if (stream) write(stream);
    stream.close();
    if (!stream) {
      throw Error(ErrorKind::kResource,
                  fmt::format("{}: cannot be written; is the folder there, writable, and not full?",
                              path.string()));
    }
  });
}

void WriteFolderAtomically(const fs::path& folder,
                           const std::function<void(const fs::path& temporary)>& write) {
  CheckIsFree(folder);
  PartialFolder partial(NamedFolder(folder));
  write(partial.path());
  partial.Finish();
}

}  // namespace curvefusion
