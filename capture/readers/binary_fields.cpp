#include "capture/readers/binary_fields.h"

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

BinaryFields::BinaryFields(const std::filesystem::path& path)
    : path_(path.string()), stream_(OpenFile(path)), size_(std::filesystem::file_size(path)) {}

void BinaryFields::RequireLeft(std::uint64_t bytes) const {
  if (bytes <= left()) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: ends too early, at byte {}; copy or export it again", path_, size_));
}

void BinaryFields::Read(void* target, std::uint64_t bytes) {
  RequireLeft(bytes);
  stream_.read(static_cast<char*>(target), static_cast<std::streamsize>(bytes));
  if (!stream_) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: cannot be read at byte {}", path_, position_));
  }
  position_ += bytes;
}

void BinaryFields::Skip(std::uint64_t bytes) {
  RequireLeft(bytes);
  stream_.seekg(static_cast<std::streamoff>(bytes), std::ios::cur);
  position_ += bytes;
}

}  // namespace curvefusion
