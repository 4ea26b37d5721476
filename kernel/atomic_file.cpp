#include "kernel/atomic_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <system_error>

#include "kernel/error.h"

namespace curvefusion {

namespace fs = std::filesystem;

void WriteFileAtomically(const fs::path& path,
                         const std::function<void(const fs::path& temporary)>& write) {
  fs::path temporary = path;
  temporary.replace_filename(
      fmt::format("{}.partial-{}{}", path.stem().string(), ::getpid(), path.extension().string()));
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
    throw Error(ErrorKind::kResource,
                fmt::format("{}: cannot be written ({})", path.string(), reason));
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

}  // namespace curvefusion
