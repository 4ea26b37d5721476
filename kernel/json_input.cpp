#include "kernel/json_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "kernel/error.h"

namespace curvefusion {

namespace {

constexpr int kMaxDepth = 16;

// nlohmann's parser could ask at every level, but looks through all elements of an array after each
// of them then: quadratic.
void RequireShallow(const std::string& text, const std::string& source) {
  int depth = 0;
  bool in_string = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    }
    if (depth > kMaxDepth)
      throw Error(ErrorKind::kBadInput,
                  fmt::format("{}: is nested deeper than {} levels; it is no file that this "
                              "program reads",
                              source, kMaxDepth));
  }
}

// What the parser's message means, in the words of a person who edits the file.
std::string PlainReason(const std::string& text, size_t position, const std::string& jargon) {
  const auto tells = [&jargon](const char* words) {
    return jargon.find(words) != std::string::npos;
  };
  if (position >= text.size() && !tells("UTF-8"))
    return "the text ends too early; is it truncated?";
  if (tells("UTF-8")) return "a byte that is not UTF-8";
  if (tells("control character")) return "a line break or control character within quotes";
  if (tells("after '\\'")) return "an unknown escape sequence after a backslash";
  if (tells("unexpected end of input") || tells("expected end of input")) {
    return fmt::format("'{}' after the end of the value", text[position]);
  }
  if (tells("comment")) return "a comment, which JSON does not have";
  return fmt::format("'{}' does not belong here; is a comma, colon, quote or bracket missing?",
                     text[position]);
}

Error NotJson(const std::string& text, const std::string& source, size_t position,
              const std::string& jargon) {
  const std::string before = text.substr(0, position);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const size_t line_begin = before.rfind('\n') + 1;  // 0 where there is none
  return {ErrorKind::kBadInput,
          fmt::format("{}: not valid JSON: line {}, column {}: {}", source, line,
                      position - line_begin + 1, PlainReason(text, position, jargon))};
}

}  // namespace

nlohmann::json ParseJson(const std::string& text, const std::string& source) {
  RequireShallow(text, source);
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    // The parser counts from 1, up to the last byte of what it could not understand.
    throw NotJson(text, source, std::max<size_t>(error.byte, 1) - 1, error.what());
  } catch (const nlohmann::json::out_of_range&) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: not valid JSON: holds a number of more than 1.8e308", source));
  }
}

}  // namespace curvefusion
