#include "graph/io/graphml_nesting.h"

#include <fmt/format.h>

#include <algorithm>

#include "kernel/error.h"

namespace curvefusion {

namespace {

// Chosen: curves in GraphML are four elements deep.
constexpr int kMaxDepth = 32;

// What follows the first `end` in the text; nothing where it does not hold one.
std::string_view After(std::string_view text, std::string_view end) {
  const size_t at = text.find(end);
  return at == std::string_view::npos ? std::string_view() : text.substr(at + end.size());
}

// The length of a tag that begins at the front, up to and with its '>', which may stand in quotes.
size_t TagLength(std::string_view text) {
  char quote = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0) {
      quote = c == quote ? char{0} : quote;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return i + 1;
    }
  }
  return text.size();
}

}  // namespace

void RequireShallowXml(std::string_view text, const std::string& source) {
  const auto fail = [&source](const std::string& what) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", source, what));
  };
  int depth = 0;
  while (true) {
    text.remove_prefix(std::min(text.find('<'), text.size()));
    if (text.empty()) return;
    if (text.starts_with("<!--")) {
      text = After(text.substr(4), "-->");
    } else if (text.starts_with("<![CDATA[")) {
      text = After(text.substr(9), "]]>");
    } else if (text.starts_with("<?")) {
      text = After(text.substr(2), "?>");
    } else if (text.starts_with("<!")) {
      fail("a document type is not read; remove the lines of <!DOCTYPE");
    } else {
      const std::string_view tag = text.substr(0, TagLength(text));
      depth += tag.starts_with("</") ? -1 : tag.ends_with("/>") ? 0 : 1;
      if (depth > kMaxDepth) fail(fmt::format("is nested deeper than {} elements", kMaxDepth));
      if (depth < 0) fail("closes more elements than it opens");
      text.remove_prefix(tag.size());
    }
  }
}

}  // namespace curvefusion
