#include "experiments/sweeps/settings_report.h"

#include <gmock/gmock.h>

#include "tests/experiments/studies/gnuplot_fixture.h"
#include "tests/file_contents.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

StudyRun RunWith(const std::string& setting, double f2) {
  return {{{"object", "cage"}, {"profile", "best"}, {"setting", setting}},
          1,
          "done",
          "",
          "",
          {},
          {{"aligned.curves.2mm.f", f2}}};
}

class SettingsReport : public WithGnuplot {
 protected:
  bool Exists(const std::string& name) const { return fs::exists(folder_ / name); }

  const TemporaryFolder folder_{"settings_report"};
};

TEST_F(SettingsReport, TellsFiguresAndTheirRatioToTheDefault) {
  const StudyResults results{
      folder_, "all", {RunWith("default", 0.8), RunWith("a.b=1", 0.4), RunWith("a.b=2", 0.88)}};
  ReportSettings(results, true);
  const std::string table = FileText(folder_ / "all.md");
  EXPECT_THAT(table, HasSubstr("0.800 (1.00)"));
  EXPECT_THAT(table, HasSubstr("0.400 (0.50)"));
  for (const char* name : {"all.tex", "all.png", "all.pdf", "all_curves.png"}) {
    EXPECT_TRUE(Exists(name)) << name;
  }
}

TEST_F(SettingsReport, DrawsNoCurveOverTwoKeysAndNothingOfTheDefaultAlone) {
  ReportSettings(
      {folder_, "keys", {RunWith("default", 0.8), RunWith("a.b=1", 0.4), RunWith("c.d=2", 0.88)}},
      true);
  EXPECT_TRUE(Exists("keys.png"));
  EXPECT_FALSE(Exists("keys_curves.png"));
  ReportSettings({folder_, "alone", {RunWith("default", 0.8)}}, true);
  EXPECT_TRUE(Exists("alone.md"));
  EXPECT_FALSE(Exists("alone.png"));
  ReportSettings({folder_, "without", {RunWith("a.b=1", 0.8), RunWith("a.b=2", 0.8)}}, true);
  EXPECT_TRUE(Exists("without.md"));
}

}  // namespace
}  // namespace curvefusion
