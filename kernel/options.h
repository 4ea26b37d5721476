#pragma once

#include <limits>
#include <string>
#include <vector>

namespace curvefusion {

/// What is said of one option beside its default: printed by --help and written into the config
/// file.
struct OptionInfo {
  const char* name;         ///< key in the config file
  const char* unit;         ///< "m", "px", "frames", "" for a pure number
  double min;               ///< least allowed value
  double max;               ///< greatest allowed value
  const char* description;  ///< one sentence; ends with its source ("CurveFusion 4.1") or begins
                            ///< with "Deviation:" where the best profile leaves the paper
};

/// Walks over the options of a struct: the config reader, the config writer and --help are
/// visitors. Each options struct XOptions has a function `void VisitOptions(XOptions&,
/// OptionVisitor&)`.
class OptionVisitor {
 public:
  virtual ~OptionVisitor() = default;
  /// The options that follow belong to this table of the config file ("fusion").
  virtual void BeginSection(const char* name) = 0;
  virtual void Visit(const OptionInfo& info, double& value) = 0;
  virtual void Visit(const OptionInfo& info, int& value) = 0;
  virtual void Visit(const OptionInfo& info, bool& value) = 0;
  /// One of several words, of which `value` is the place.
  virtual void VisitChoice(const OptionInfo& info, const std::vector<std::string>& /*words*/,
                           int& value) {
    Visit(info, value);
  }
};

/// The name out of `known` with the least edit distance to `name`; empty where `known` is.
std::string NearestName(const std::string& name, const std::vector<std::string>& known);

}  // namespace curvefusion
