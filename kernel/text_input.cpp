#include "kernel/text_input.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <system_error>

#include "kernel/error.h"

namespace curvefusion {

namespace {

constexpr size_t kChunkBytes = 1 << 16;

// from_chars of a whole word; it takes no plus sign.
template <class Number>
std::optional<Number> Parse(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  Number value{};
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failure != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace

std::string ReadingObstacle(const std::filesystem::path& path) {
  std::error_code failure;
  const std::filesystem::file_status status = std::filesystem::status(path, failure);
  switch (status.type()) {
    case std::filesystem::file_type::not_found:
      return "is not there";
    case std::filesystem::file_type::directory:
      return "is a folder, not a file";
    case std::filesystem::file_type::regular:
      break;
    case std::filesystem::file_type::none:
      return fmt::format("cannot be read ({})", failure.message());
    default:
      return "is a pipe or a device, not a regular file";
  }
  if (::access(path.c_str(), R_OK) == 0) return "";
  return fmt::format("cannot be read ({})", std::generic_category().message(errno));
}

std::ifstream OpenFile(const std::filesystem::path& path) {
  std::string obstacle = ReadingObstacle(path);
  std::ifstream stream;
  bool lacks_resource = false;
  if (obstacle.empty()) {
    stream.open(path, std::ios::binary);
    if (stream) return stream;
    lacks_resource = errno == EMFILE || errno == ENFILE || errno == ENOMEM;
    obstacle = fmt::format("cannot be opened ({})", std::generic_category().message(errno));
  }
  throw Error(
      lacks_resource ? ErrorKind::kResource : ErrorKind::kBadInput,
      fmt::format("{}: {}; is the name right and the file readable?", path.string(), obstacle));
}

std::string ReadFile(const std::filesystem::path& path, std::uintmax_t max_bytes) {
  std::ifstream stream = OpenFile(path);
  std::string content;
  std::array<char, kChunkBytes> chunk;
  while (stream.read(chunk.data(), chunk.size()) || stream.gcount() > 0) {
    content.append(chunk.data(), static_cast<size_t>(stream.gcount()));
    if (content.size() > max_bytes) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("{}: is larger than the {} MiB that are read of such a file",
                              path.string(), max_bytes >> 20));
    }
  }
  if (stream.bad())
    throw Error(ErrorKind::kBadInput, fmt::format("{}: cannot be read to its end", path.string()));
  return content;
}

bool LineScanner::Next(std::string_view& line) {
  if (rest_.empty()) return false;
  const size_t end = rest_.find('\n');
  line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  ++number_;
  return true;
}

std::string_view NextWord(std::string_view& line) {
  constexpr std::string_view kBlank = " \t\r,";
  line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlank));
  line.remove_prefix(word.size());
  return word;
}

std::optional<double> ParseNumber(std::string_view word) { return Parse<double>(word); }

std::optional<int64_t> ParseInteger(std::string_view word) { return Parse<int64_t>(word); }

}  // namespace curvefusion
