#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace curvefusion {

/// Parses JSON that may come from anywhere. `source` names it in errors. Throws Error(kBadInput)
/// for what is not valid JSON (with line and column) and for arrays and objects nested deeper than
/// 16, which no file of this project has and which would exhaust memory or stack.
nlohmann::json ParseJson(const std::string& text, const std::string& source);

}  // namespace curvefusion
