#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "kernel/options.h"

namespace curvefusion {

/// Makes JSON of options, with their sections.
class OptionsJsonVisitor : public OptionVisitor {
 public:
  void BeginSection(const char* name) override { section_ = std::string(name) + "."; }
  void Visit(const OptionInfo& info, double& value) override { Add(info, value); }
  void Visit(const OptionInfo& info, int& value) override { Add(info, value); }
  void Visit(const OptionInfo& info, bool& value) override { Add(info, value); }
  const nlohmann::ordered_json& json() const { return json_; }

 private:
  template <class Value>
  void Add(const OptionInfo& info, Value value) {
    json_[section_ + info.name] = value;
  }

  std::string section_;
  nlohmann::ordered_json json_;
};

template <class Options>
nlohmann::ordered_json OptionsJson(Options options) {
  OptionsJsonVisitor visitor;
  VisitOptions(options, visitor);
  return visitor.json();
}

}  // namespace curvefusion
