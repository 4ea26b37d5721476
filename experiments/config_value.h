#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>

#include "kernel/options.h"

namespace curvefusion {

/// Why a value is not what an option wants ("a number", "a whole number", "true or false"), and
/// where it can be told what to write: "4mm is not a number; the unit is metres: 0.004".
std::string WrongValueText(const toml::node& value, const OptionInfo& option,
                           const std::string& wanted);

/// "a.b=4mm" as a table that holds the value as a text, for assignments that are no TOML because
/// their value is none (4mm, or nothing). Nothing where there is no name or no value at all.
std::optional<toml::table> TextAssigned(const std::string& assignment);

/// Throws Error(kUsage), naming the source, for control characters that TOML has not: toml++
/// asserts that it gets none.
void RefuseControlCharacters(const std::string& text, const std::string& source);

}  // namespace curvefusion
