#include "kernel/json_input.h"

#include <fmt/format.h>

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

}  // namespace

nlohmann::json ParseJson(const std::string& text, const std::string& source) {
  RequireShallow(text, source);
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: not valid JSON: {}", source, error.what()));
  }
}

}  // namespace curvefusion
