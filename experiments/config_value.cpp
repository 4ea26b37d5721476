#include "experiments/config_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <string_view>

#include "kernel/error.h"

namespace curvefusion {

namespace {

// What people write behind numbers, in the units of options.
struct UnitSuffix {
  std::string_view suffix;
  std::string_view unit;  // of the option
  double factor;
};

constexpr UnitSuffix kSuffixes[] = {
    {"m", "m", 1},
    {"mm", "m", 1e-3},
    {"cm", "m", 1e-2},
    {"um", "m", 1e-6},
    {"µm", "m", 1e-6},
    {"in", "m", 0.0254},
    {"rad", "rad", 1},
    {"deg", "rad", std::numbers::pi / 180},
    {"°", "rad", std::numbers::pi / 180},
    {"px", "px", 1},
    {"%", "", 1e-2},
};

std::string UnitName(std::string_view unit) {
  if (unit == "m") return "metres";
  if (unit == "rad") return "radians";
  if (unit == "px") return "pixels";
  return std::string(unit);
}

// "4mm" or "4 mm" in the unit of the option.
std::optional<double> Converted(const std::string& text, std::string_view unit) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || !std::isfinite(number)) return std::nullopt;
  std::string_view suffix(end);
  while (suffix.starts_with(' ')) suffix.remove_prefix(1);
  for (const UnitSuffix& known : kSuffixes) {
    if (known.suffix == suffix && known.unit == unit) return number * known.factor;
  }
  return std::nullopt;
}

std::string ValueText(const toml::node& value) {
  if (const auto* text = value.as_string()) return text->get();
  if (const auto* number = value.as_integer()) return fmt::format("{}", number->get());
  if (const auto* number = value.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* truth = value.as_boolean()) return truth->get() ? "true" : "false";
  if (value.is_array()) return "a list";
  return value.is_table() ? "a table" : "a date or time";
}

std::string Trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? ""
                                    : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

}  // namespace

std::string WrongValueText(const toml::node& value, const OptionInfo& option,
                           const std::string& wanted) {
  const std::string text = ValueText(value);
  if (text.empty()) return fmt::format("there is no value; write {}", wanted);
  const std::string refusal = fmt::format("{} is not {}", text, wanted);
  if (!value.is_string() || wanted == "true or false") return refusal;
  const std::string_view unit = option.unit;
  const std::string of_unit = unit.empty() ? "" : fmt::format("the unit is {}", UnitName(unit));
  if (const auto converted = Converted(text, unit)) {
    const std::string number = fmt::format("{:.10g}", *converted);
    return fmt::format("{}; {}", refusal,
                       of_unit.empty() ? "write " + number : of_unit + ": " + number);
  }
  return of_unit.empty() ? refusal : fmt::format("{}; {}", refusal, of_unit);
}

std::optional<toml::table> TextAssigned(const std::string& assignment) {
  const size_t equals = assignment.find('=');
  if (equals == std::string::npos) return std::nullopt;
  const std::string name = Trimmed(assignment.substr(0, equals));
  const toml::value<std::string> value(Trimmed(assignment.substr(equals + 1)));
  const size_t dot = name.find('.');
  const std::string key = dot == std::string::npos ? "" : name.substr(dot + 1);
  if (name.empty() || dot == 0 || dot + 1 == name.size()) return std::nullopt;
  if (key.empty()) return toml::table{{name, value}};
  return toml::table{{name.substr(0, dot), toml::table{{key, value}}}};
}

void RefuseControlCharacters(const std::string& text, const std::string& source) {
  const auto found = std::find_if(text.begin(), text.end(), [](unsigned char c) {
    return (c < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7f;
  });
  if (found == text.end()) return;
  throw Error(ErrorKind::kUsage,
              fmt::format("{}: not valid TOML: it holds the control character {:#x}", source,
                          static_cast<int>(*found)));
}

}  // namespace curvefusion
