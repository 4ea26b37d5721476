#include "capture/text_lines.h"

#include <fmt/format.h>

#include <charconv>
#include <fstream>

#include "kernel/error.h"

namespace curvefusion {

std::vector<TextLine> ReadTextLines(const std::filesystem::path& path) {
  std::ifstream stream(path);
  if (!stream) throw Error(ErrorKind::kBadInput, fmt::format("{}: cannot be read", path.string()));
  constexpr const char* kSeparators = " \t\r,";
  std::vector<TextLine> lines;
  std::string text;
  for (int number = 1; std::getline(stream, text); ++number) {
    text.resize(std::min(text.find('#'), text.size()));
    TextLine line{number, {}};
    size_t begin = text.find_first_not_of(kSeparators);
    while (begin != std::string::npos) {
      const size_t end = std::min(text.find_first_of(kSeparators, begin), text.size());
      line.fields.push_back(text.substr(begin, end - begin));
      begin = text.find_first_not_of(kSeparators, end);
    }
    if (!line.fields.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

std::optional<double> ParseNumber(const std::string& field) {
  const char* begin = field.data();
  const char* end = begin + field.size();
  if (begin != end && *begin == '+') ++begin;
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace curvefusion
