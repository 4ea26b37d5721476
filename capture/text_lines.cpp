#include "capture/text_lines.h"

#include "kernel/text_input.h"

namespace curvefusion {

std::vector<TextLine> ReadTextLines(const std::filesystem::path& path) {
  const std::string text = ReadFile(path);
  LineScanner scanner(text);
  std::vector<TextLine> lines;
  for (std::string_view rest; scanner.Next(rest);) {
    rest = rest.substr(0, rest.find('#'));
    TextLine line{static_cast<int>(scanner.number()), {}};
    for (std::string_view word = NextWord(rest); !word.empty(); word = NextWord(rest))
      line.fields.emplace_back(word);
    if (!line.fields.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace curvefusion
