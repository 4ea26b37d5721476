#include "experiments/studies/ablations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "experiments/config.h"
#include "experiments/simulation/families/scan_draw.h"
#include "experiments/studies/studies.h"

namespace curvefusion {
namespace {

struct DocumentedOption {
  std::string description;
  std::string value;
};

// Every option by "section.key", as `curvefusion config` documents it.
class OptionCollector : public OptionVisitor {
 public:
  void BeginSection(const char* name) override { section_ = name; }
  void Visit(const OptionInfo& info, double& value) override { Add(info, std::to_string(value)); }
  void Visit(const OptionInfo& info, int& value) override { Add(info, std::to_string(value)); }
  void Visit(const OptionInfo& info, bool& value) override { Add(info, std::to_string(value)); }

  std::map<std::string, DocumentedOption> options;

 private:
  void Add(const OptionInfo& info, const std::string& value) {
    options[section_ + "." + info.name] = {info.description, value};
  }

  std::string section_;
};

std::map<std::string, DocumentedOption> BestOptionsByName() {
  Config config = ProfileConfig(Profile::kBest);
  OptionCollector collector;
  VisitOptions(config, collector);
  return collector.options;
}

std::string KeyOf(const std::string& assignment) {
  return assignment.substr(0, assignment.find('='));
}

bool IsPartOf(const Ablation& ablation, const std::string& option) {
  const auto assigns = [&](const std::string& assignment) { return KeyOf(assignment) == option; };
  const auto names = [&](const std::string& part) {
    return part == option || part == option.substr(0, option.find('.'));
  };
  return std::any_of(ablation.off.begin(), ablation.off.end(), assigns) ||
         std::any_of(ablation.parts.begin(), ablation.parts.end(), names);
}

bool IsAccountedFor(const std::string& option) {
  for (const Ablation& ablation : Ablations()) {
    if (IsPartOf(ablation, option)) return true;
  }
  for (const FixedDeviation& fixed : FixedDeviations()) {
    if (fixed.option == option) return true;
  }
  return false;
}

TEST(Ablations, NoDeviationIsForgotten) {
  int deviations = 0;
  for (const auto& [option, documented] : BestOptionsByName()) {
    if (documented.description.find("Deviation:") == std::string::npos) continue;
    ++deviations;
    EXPECT_TRUE(IsAccountedFor(option)) << option << ": " << documented.description;
  }
  EXPECT_GT(deviations, 50);  // the documentation is read at all
}

TEST(Ablations, EachSetsSomethingElseThanTheProfileHas) {
  for (const Ablation& ablation : Ablations()) {
    Config config;
    EXPECT_NO_THROW(config = ReadConfig({Profile::kBest, {}, ablation.off})) << ablation.name;
    OptionCollector collector;
    VisitOptions(config, collector);
    const auto full = BestOptionsByName();
    for (const std::string& assignment : ablation.off) {
      const std::string option = KeyOf(assignment);
      EXPECT_NE(collector.options.at(option).value, full.at(option).value) << assignment;
    }
    EXPECT_FALSE(ablation.purpose.empty()) << ablation.name;
  }
}

TEST(Ablations, PartsAndFixedOnesExist) {
  const auto best = BestOptionsByName();
  for (const Ablation& ablation : Ablations()) {
    for (const std::string& part : ablation.parts) {
      const bool exists = std::any_of(best.begin(), best.end(), [&](const auto& option) {
        return option.first == part || option.first.starts_with(part + ".");
      });
      EXPECT_TRUE(exists) << part;
    }
  }
  for (const FixedDeviation& fixed : FixedDeviations()) {
    ASSERT_EQ(best.count(fixed.option), 1u) << fixed.option;
  }
}

TEST(Ablations, AreRunOnScansOfEveryFamily) {
  std::set<std::string> families;
  const auto cases = AblationStudy().cases({.seeds = 1});
  for (const StudyCase& study_case : cases) families.insert(study_case.scan->object);
  EXPECT_EQ(cases.size(), FamilyNames().size() * (Ablations().size() + 1));
  std::set<std::string> drawn;
  for (const std::string& family : FamilyNames()) drawn.insert(DrawScan(family, 1).object);
  EXPECT_EQ(families, drawn);
}

TEST(Ablations, NamesAreUnique) {
  std::set<std::string> names;
  for (const Ablation& ablation : Ablations()) {
    EXPECT_TRUE(names.insert(ablation.name).second) << ablation.name;
  }
}

}  // namespace
}  // namespace curvefusion
