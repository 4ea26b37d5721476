#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "kernel/error.h"
#include "tests/temporary_path.h"

/// What libFuzzer calls for each input, and the replay for each file of the corpus.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace curvefusion {

/// Calls `read`; an Error is an answer, everything else that comes out of it is a finding.
template <class Read>
void AcceptErrors(const Read& read) {
  try {
    read();
  } catch (const Error&) {
  }
}

/// The input as a reader of text takes it.
inline std::string_view Text(const uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A folder of this process for readers that take paths; removed at its end.
class InputFolder {
 public:
  InputFolder() { std::filesystem::create_directories(path_); }
  ~InputFolder() { std::filesystem::remove_all(path_); }
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Writes a file of the folder and returns its path.
  std::filesystem::path Write(const std::string& name, std::string_view content) const {
    std::ofstream stream(path_ / name, std::ios::binary | std::ios::trunc);
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
    return path_ / name;
  }

 private:
  std::filesystem::path path_ = TemporaryPath("fuzz");
};

}  // namespace curvefusion
