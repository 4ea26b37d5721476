#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace curvefusion {

/// What text files of this project may have at most: a skeleton of 500 m of wire at 1 mm, or the
/// trajectory of a day. A larger file is another one by mistake, and would fill the memory.
inline constexpr std::uintmax_t kMaxTextBytes = 128u << 20;

/// What keeps a path from being read like a file: "is not there", "is a folder, not a file", "is a
/// pipe or a device, not a regular file" (which could make a reader wait for ever), "cannot be read
/// (Permission denied)". Empty where nothing does.
std::string ReadingObstacle(const std::filesystem::path& path);

/// Opens a file in binary mode. Throws Error(kBadInput) with the obstacle and a remedy.
std::ifstream OpenFile(const std::filesystem::path& path);

/// The content of a file, byte by byte. Throws Error(kBadInput) where it cannot be opened or read
/// to its end, or has more than `max_bytes`.
std::string ReadFile(const std::filesystem::path& path, std::uintmax_t max_bytes = kMaxTextBytes);

/// Hands out a text line by line, without line ends of either kind, and counts the lines from 1.
class LineScanner {
 public:
  explicit LineScanner(std::string_view text) : rest_(text) {}

  /// Sets `line` to the next line; false at the end.
  bool Next(std::string_view& line);

  size_t number() const { return number_; }        ///< of the line handed out last
  std::string_view rest() const { return rest_; }  ///< what follows that line

 private:
  std::string_view rest_;
  size_t number_ = 0;
};

/// The next word of a line, which is cut from its front; words are separated by blanks, tabs and
/// commas. Empty at the end.
std::string_view NextWord(std::string_view& line);

/// The number a whole word spells (also "nan" and "inf", whatever the locale), or nothing.
std::optional<double> ParseNumber(std::string_view word);

/// The integer a whole word spells, or nothing.
std::optional<int64_t> ParseInteger(std::string_view word);

}  // namespace curvefusion
