#include "kernel/atomic_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>

#include "kernel/partial_folder.h"
#include "kernel/partial_name.h"
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

// Renaming would put a file in place of a device or a pipe.
void RequireReplaceable(const fs::path& path) {
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  if (!fs::exists(status) || fs::is_regular_file(status)) return;
  throw CannotBeWritten(path, fs::is_directory(status) ? "is a folder" : "is not a regular file");
}

}  // namespace

void WriteFileAtomically(const fs::path& path,
                         const std::function<void(const fs::path& temporary)>& write) {
  RequireReplaceable(path);
  const fs::path temporary = PartialFilePath(path);
  const UnfinishedPath marked(temporary);
  std::error_code failure;
  try {
    write(temporary);
    fs::rename(temporary, path, failure);
  } catch (const Error& error) {
    fs::remove(temporary, failure);
    throw WithPathReplaced(error, temporary, path);
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
    errno = 0;
    std::ofstream stream(temporary, std::ios::binary);
    if (stream) write(stream);
    stream.close();
    if (stream) return;
    throw CannotBeWritten(path, errno != 0 ? std::generic_category().message(errno)
                                           : "is the folder there, writable, and not full?");
  });
}

void WriteBytesAtomically(const std::filesystem::path& path, std::string_view bytes) {
  WriteStreamAtomically(path, [&](std::ostream& stream) { stream << bytes; });
}

void WriteFolderAtomically(const fs::path& folder,
                           const std::function<void(const fs::path& temporary)>& write) {
  CheckIsFree(folder);
  PartialFolder partial(NamedFolder(folder));
  try {
    write(partial.path());
  } catch (const Error& error) {
    throw WithPathReplaced(error, partial.path(), folder);
  }
  CheckIsFree(folder);  // what came meanwhile would be lost
  partial.Finish();
}

Error WithPathReplaced(const Error& error, const fs::path& path, const fs::path& replacement) {
  std::string message = error.what();
  const std::string& from = path.native();
  const std::string& to = replacement.native();
  for (size_t at = message.find(from); at != std::string::npos;
       at = message.find(from, at + to.size())) {
    message.replace(at, from.size(), to);
  }
  return {error.kind(), message};
}

}  // namespace curvefusion
