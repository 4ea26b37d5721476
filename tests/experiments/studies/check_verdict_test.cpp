#include "experiments/studies/check_verdict.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "capture/check.h"
#include "capture/check_json.h"
#include "experiments/studies/wrong_versions.h"
#include "tests/capture/content/room_scan.h"
#include "tests/capture/sequence_fixture.h"

namespace curvefusion {
namespace {

constexpr double kPeriod = 1 / 30.0;

CheckVerdict Judge(const std::vector<CheckFinding>& findings, const Mistake& expected,
                   const std::vector<Mistake>& mistakes = {}) {
  CheckReport report;
  report.findings = findings;
  report.geometry.mistakes = mistakes;
  return JudgeCheck(nlohmann::json::parse(CheckJson(report)),
                    {expected, false, {"a", "b", "c", "d", "e", "f"}, kPeriod});
}

// Whether one mistake is taken for the other.
bool IsTaken(const Mistake& found, const Mistake& expected) {
  return Judge({{Severity::kWarning, "", found.cause}}, expected, {found}).is_right;
}

Mistake By(const std::string& cause, double amount, const std::string& unit) {
  return {cause, {}, MistakeAmount{amount, unit}};
}

Mistake At(const std::string& cause, const std::string& first, const std::string& last) {
  return {cause, {{first, last}}};
}

TEST(CheckVerdict, AGoodScanHasRemarksButNoComplaint) {
  const CheckFinding too_far{Severity::kWarning, "", "too-far"};
  EXPECT_TRUE(Judge({}, {}).is_right);
  EXPECT_TRUE(Judge({too_far}, {}).is_right);
  EXPECT_EQ(Judge({too_far}, {}).remarks, "too-far");
  EXPECT_FALSE(Judge({{Severity::kError, "", "too-far"}}, {}).is_right);
  EXPECT_FALSE(Judge({{Severity::kWarning, "unreadable", ""}}, {}).is_right);
  EXPECT_FALSE(Judge({{Severity::kWarning, "", "colour-misregistered"}}, {}).is_right);
}

TEST(CheckVerdict, TheCauseMustBeTheOnlyOne) {
  const CheckFinding inverted{Severity::kError, "", "poses-inverted"};
  const Mistake expected{"poses-inverted"};
  EXPECT_TRUE(Judge({inverted}, expected).is_right);
  EXPECT_TRUE(Judge({inverted, {Severity::kWarning, "frames without pose"}}, expected).is_right);
  EXPECT_FALSE(Judge({}, expected).is_right);
  EXPECT_FALSE(Judge({inverted, {Severity::kError, "", "opengl-axes"}}, expected).is_right);
}

TEST(CheckVerdict, TheAmountMustBeRight) {
  const Mistake late = By("poses-late", 3, "frames");
  EXPECT_TRUE(IsTaken(late, late));
  EXPECT_FALSE(IsTaken(By("poses-late", 2, "frames"), late));
  const Mistake clock = By("clock-offset", 0.25, "s");
  EXPECT_TRUE(IsTaken(By("clock-offset", 0.25 + 0.4 * kPeriod, "s"), clock));
  EXPECT_FALSE(IsTaken(By("clock-offset", 0.25 + 0.6 * kPeriod, "s"), clock));
  const Mistake scale = By("translation-scale", 0.37, "factor");
  EXPECT_TRUE(IsTaken(By("translation-scale", 0.38, "factor"), scale));
  EXPECT_FALSE(IsTaken(By("translation-scale", 0.41, "factor"), scale));
}

TEST(CheckVerdict, TheFramesMustBeRight) {
  const Mistake jump = At("pose-jump", "b", "c");
  EXPECT_TRUE(IsTaken(jump, jump));
  EXPECT_FALSE(IsTaken(At("pose-jump", "b", "d"), jump));
  const Mistake stretch = At("bad-stretch", "b", "e");
  EXPECT_TRUE(IsTaken(At("bad-stretch", "c", "e"), stretch));
  EXPECT_FALSE(IsTaken(At("bad-stretch", "e", "f"), stretch));
}

// Every mistake but those of the colour camera, for which a room of 80x60 pixels has too few edges,
// and lost tracking: 6 degrees of pitch before a wall move depth by less than 2.5 %
// (GeometryCheck.ABadStretchIsListed).
TEST(WrongVersions, AreNamedInASmallRoom) {
  const TemporaryFolder folder;
  WriteRoomScan(MakeRoomScan(), folder.path() / "room");
  for (const WrongVersion& version : WrongVersions()) {
    if (version.cause == "colour-misregistered" || version.cause == "bad-stretch") continue;
    CheckExpectation expected;
    const std::filesystem::path scan = folder.path() / version.name;
    expected.mistake = WriteWrongVersion(folder.path() / "room", version.name, scan);
    expected.frame_period = 1 / kRoomFrameRate;
    for (const SequenceFrame& frame : OpenSequence(folder.path() / "room").frames) {
      expected.frame_names.push_back(frame.name);
    }
    const auto check = nlohmann::json::parse(CheckJson(CheckSequence(scan, NoProgress)));
    const CheckVerdict verdict = JudgeCheck(check, expected);
    EXPECT_TRUE(verdict.is_right) << version.name << ": " << verdict.named;
  }
}

}  // namespace
}  // namespace curvefusion
