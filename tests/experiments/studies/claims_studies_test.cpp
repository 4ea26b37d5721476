// Studies of single claims of the paper: do their scans differ in what is claimed, and in nothing
// else?
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "experiments/simulation/scan_settings.h"
#include "experiments/studies/studies.h"

namespace curvefusion {
namespace {

using testing::SizeIs;

// Both profiles must see the same scan: a set of settings per value of the label.
std::map<std::string, std::set<std::string>> ScansBy(const Study& study, const std::string& label) {
  std::map<std::string, std::set<std::string>> scans;
  for (const StudyCase& study_case : study.cases({.quick = true}))
    scans[LabelOf(study_case.labels, label)].insert(ScanSettings(*study_case.scan));
  return scans;
}

TEST(RgbResolutionStudy, ScansDifferInTheSizeOfColourAlone) {
  const auto scans = ScansBy(RgbResolutionStudy(), "colour");
  ASSERT_THAT(scans, SizeIs(2));
  EXPECT_THAT(scans.at("640x480"), SizeIs(2));  // two objects, not one scan a profile
  EXPECT_THAT(scans.at("1280x1024"), SizeIs(2));
  for (StudyCase& study_case : RgbResolutionStudy().cases({.quick = true})) {
    const bool large = LabelOf(study_case.labels, "colour") == "1280x1024";
    EXPECT_EQ(study_case.scan->large_color, large);
    study_case.scan->large_color = false;
    EXPECT_EQ(scans.at("640x480").count(ScanSettings(*study_case.scan)), 1u);
  }
}

}  // namespace
}  // namespace curvefusion
