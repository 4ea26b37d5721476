// Studies of single claims of the paper: do their scans differ in what is claimed, and in nothing
// else?
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "experiments/simulation/objects.h"
#include "experiments/simulation/scan_settings.h"
#include "experiments/studies/fine_scan.h"
#include "experiments/studies/studies.h"

namespace curvefusion {
namespace {

using testing::ElementsAre;
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

TEST(ThicknessColourStudy, ScansDifferInTheFinishOfWiresAlone) {
  const auto scans = ScansBy(ThicknessColourStudy(), "albedo");
  ASSERT_THAT(scans, SizeIs(3));
  EXPECT_THAT(scans.at("0.3"), SizeIs(1));
  for (StudyCase& study_case : ThicknessColourStudy().cases({.quick = true})) {
    SceneOptions& scene = study_case.scan->scene;
    EXPECT_EQ(study_case.scan->object, "triangles");
    EXPECT_EQ(scene.wire_albedo, std::stod(LabelOf(study_case.labels, "albedo")));
    EXPECT_EQ(scene.wire_shininess, std::stod(LabelOf(study_case.labels, "shininess")));
    EXPECT_EQ(scene.wire_saturation, 0);
    scene.wire_albedo = 0.9;
    scene.wire_shininess = 0;
    EXPECT_EQ(scans.at("0.9").count(ScanSettings(*study_case.scan)), 1u);
  }
}

TEST(PosesStudy, ScansDifferInPosesAndRegistrationAlone) {
  const auto scans = ScansBy(PosesStudy(), "poses");
  ASSERT_THAT(scans, SizeIs(7));
  for (StudyCase& study_case : PosesStudy().cases({.quick = true})) {
    const std::string poses = LabelOf(study_case.labels, "poses");
    const bool is_tracked = poses == "depth and colour" || poses == "depth alone";
    EXPECT_EQ(study_case.scan->pose_source, is_tracked ? "orbslam2" : poses);
    const Registration colour = study_case.scan->color.registration;
    EXPECT_EQ(RegistrationName(colour), LabelOf(study_case.labels, "colour"));
    study_case.scan->pose_source = "true";
    study_case.scan->color.registration = Registration::kRegistered;
    EXPECT_THAT(scans.at("true"), ElementsAre(ScanSettings(*study_case.scan)));
  }
}

TEST(SensorsStudy, ScansDifferInTheSensorAlone) {
  const auto scans = ScansBy(SensorsStudy(), "sensor");
  ASSERT_THAT(scans, SizeIs(5));
  for (StudyCase& study_case : SensorsStudy().cases({.quick = true})) {
    SimulationOptions& scan = *study_case.scan;
    EXPECT_EQ(scan.sensor, LabelOf(study_case.labels, "sensor"));
    if (scan.sensor == "artec_spider") continue;  // an object for itself
    const bool is_rack = LabelOf(study_case.labels, "object") == "rack";
    EXPECT_EQ(scan.object_options.wire_diameter, (is_rack ? 8 : 5) * kMillimetre);
    scan.sensor = "kinect_v1";
    EXPECT_EQ(scans.at("kinect_v1").count(ScanSettings(scan)), 1u);
  }
}

// Half of the path would show half of the object.
TEST(ObjectScan, QuickStudiesHaveTheWholePathInFewerFrames) {
  const SimulationOptions full = ObjectScan({}, "rack", 1, {150, 30});
  const SimulationOptions quick = ObjectScan({.quick = true}, "rack", 1, {150, 30});
  EXPECT_EQ(full.frames, 150);
  EXPECT_EQ(quick.frames, 30);
  EXPECT_DOUBLE_EQ(full.frames / full.motion.frame_rate, quick.frames / quick.motion.frame_rate);
}

// The object is as much smaller as its wire is thinner, and so are the lengths of the paper
// profile.
TEST(FineScan, IsScaledAsAWhole) {
  const SimulationOptions scan = FineScan({}, 1, {});
  const std::vector<WireCurve> own = MakeObject("breadholder").curves;
  const std::vector<WireCurve>& small = scan.object_options.curves;
  ASSERT_EQ(small.size(), own.size());
  for (size_t i = 0; i < own.size(); ++i) {
    EXPECT_NEAR(small[i].diameter, 1.5 * kMillimetre, 1e-12);
    EXPECT_NEAR((small[i].points.back() - 0.3 * own[i].points.back()).norm(), 0, 1e-12);
  }
  const auto paper = std::get<PaperOptions>(ConfigOfScan({}, Profile::kPaper, scan).pipeline);
  EXPECT_NEAR(paper.surfaces.opening_radius, 6 * kMillimetre, 1e-12);
  EXPECT_NEAR(paper.volume.max_depth, PaperOptions().volume.max_depth, 0);
  EXPECT_TRUE(paper.surfaces.keep_unrendered);
}

TEST(LeastThicknessStudy, ScansOfASensorDifferInTheDiameterAlone) {
  const auto scans = ScansBy(LeastThicknessStudy(), "sensor");
  ASSERT_THAT(scans, SizeIs(4));
  for (StudyCase& study_case : LeastThicknessStudy().cases({.quick = true})) {
    SimulationOptions& scan = *study_case.scan;
    if (scan.sensor == "artec_spider") continue;
    EXPECT_EQ(scan.object_options.wire_diameter,
              std::stod(LabelOf(study_case.labels, "diameter")) * kMillimetre);
    scan.object_options.wire_diameter = 8 * kMillimetre;
    EXPECT_EQ(scans.at(scan.sensor).count(ScanSettings(scan)), 1u);
  }
}

TEST(Table1Study, HasThePapersNumbersOfFrames) {
  std::map<std::string, int> frames;
  for (const StudyCase& study_case :
       Table1Study().cases({.profiles = {Profile::kBest}, .seeds = 1}))
    frames[LabelOf(study_case.labels, "row")] = study_case.scan->frames;
  EXPECT_THAT(frames, SizeIs(9));
  EXPECT_EQ(frames["dish rack"], 684);
  EXPECT_EQ(frames["chair"], 428);
  EXPECT_EQ(frames["cloth hanger"], 1136);
}

// Fair: the same scan for every method but the one that is about other poses.
TEST(ComparisonsStudy, EveryMethodSeesTheSameScanButForItsPosesOrThickWire) {
  const auto scans = ScansBy(ComparisonsStudy(), "method");
  ASSERT_THAT(scans, SizeIs(16));
  for (const auto& [method, its_scans] : scans) {
    EXPECT_THAT(its_scans, SizeIs(1));
    const bool is_other = method == "BundleFusion poses" || method == "KinectFusion, 15 mm";
    EXPECT_EQ(its_scans == scans.at("paper"), !is_other) << method;
  }
}

}  // namespace
}  // namespace curvefusion
