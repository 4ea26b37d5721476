#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace curvefusion {

/// One value after the other from a binary file, never beyond its end. Values are little-endian, as
/// all machines have them that this runs on.
class BinaryFields {
 public:
  /// Throws Error(kBadInput) where the file cannot be opened.
  explicit BinaryFields(const std::filesystem::path& path);

  /// The next value of a plain type. Throws Error(kBadInput), naming the file, at its end.
  template <class T>
  T Next() {
    T value{};
    Read(&value, sizeof(T));
    return value;
  }

  void Read(void* target, std::uint64_t bytes);
  void Skip(std::uint64_t bytes);
  std::uint64_t position() const { return position_; }
  std::uint64_t left() const { return size_ - position_; }  ///< bytes up to the end of the file

 private:
  void RequireLeft(std::uint64_t bytes) const;

  std::string path_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
  std::uint64_t position_ = 0;
};

}  // namespace curvefusion
