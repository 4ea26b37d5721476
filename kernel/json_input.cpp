#include "kernel/json_input.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "kernel/error.h"

namespace curvefusion {

namespace {

constexpr int kMaxDepth = 16;

}  // namespace

nlohmann::json ParseJson(const std::string& text, const std::string& source) {
  using Json = nlohmann::json;
  const auto check_depth = [&source](int depth, Json::parse_event_t, Json&) {
    if (depth <= kMaxDepth) return true;
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: is nested deeper than {} levels; it is no file that this program "
                            "reads",
                            source, kMaxDepth));
  };
  try {
    return Json::parse(text, check_depth);
  } catch (const Json::exception& error) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: not valid JSON: {}", source, error.what()));
  }
}

}  // namespace curvefusion
