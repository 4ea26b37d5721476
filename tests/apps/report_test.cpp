#include "apps/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/apps/result_fixtures.h"

namespace curvefusion {
namespace {

using testing::HasSubstr;
using testing::Not;

struct YRun {
  Sequence sequence;
  Config config = ProfileConfig(Profile::kPaper);
  Reconstruction reconstruction;

  YRun() {
    sequence.folder = "scans/y";
    sequence.format = "tum";
    sequence.frames.resize(60);
    sequence.frames_without_pose = 2;
    sequence.warnings = {"Two frames have no pose."};
    reconstruction.skeleton = Y();
    reconstruction.stages = {{"volume", 1.25, 3'000'000, {{"blocks", 12}}}};
    reconstruction.warnings = {"One wire is thinner than a pixel."};
  }
  RunRecord Record() {
    RunRecord record{sequence, config, reconstruction, MeshRecord{}, 10, 1000};
    record.mesh->figures.faces = 1200;
    record.mesh->warnings = {"One tube is thinner than its ends."};
    return record;
  }
};

TEST(Report, TellsWhatARunWasAndFound) {
  YRun run;
  const auto report = nlohmann::json::parse(ReportJson(run.Record()));
  EXPECT_EQ(report["profile"], "paper");
  EXPECT_TRUE(report["trust"].is_null());
  EXPECT_EQ(report["sequence"]["folder"], "scans/y");
  EXPECT_EQ(report["sequence"]["frames"], 60);
  EXPECT_EQ(report["sequence"]["frames_without_pose"], 2);
  EXPECT_EQ(report["seconds"], 10);
  EXPECT_EQ(report["seconds_per_30_frames"], 5);
  EXPECT_EQ(report["peak_memory_bytes"], 1000);
  EXPECT_EQ(report["stages"][0]["name"], "volume");
  EXPECT_EQ(report["stages"][0]["seconds"], 1.25);
  EXPECT_EQ(report["stages"][0]["counts"]["blocks"], 12);
  EXPECT_EQ(report["stages"][0]["peak_memory_bytes"], 3'000'000);
  EXPECT_EQ(report["mesh"]["faces"], 1200);
  EXPECT_EQ(report["warnings"].size(), 3u);
}

TEST(Report, TellsTheFiguresOfTheSkeleton) {
  YRun run;
  const auto skeleton = nlohmann::json::parse(ReportJson(run.Record()))["skeleton"];
  EXPECT_EQ(skeleton["nodes"], 4);
  EXPECT_EQ(skeleton["edges"], 3);
  EXPECT_EQ(skeleton["junctions"], 1);
  EXPECT_EQ(skeleton["free_ends"], 3);
  EXPECT_EQ(skeleton["components"], 1);
  EXPECT_EQ(skeleton["cycles"], 0);
  EXPECT_NEAR(skeleton["length"], 0.3, 1e-12);  // rounding of three additions
  EXPECT_NEAR(skeleton["per_edge"][2]["diameter_mm"], 6, 1e-12);
  EXPECT_TRUE(skeleton["global_diameter_mm"].is_null());
}

TEST(Report, TellsWhatEdgesAndJunctionsRestOn) {
  YRun run;
  Reconstruction& reconstruction = run.reconstruction;
  const std::vector<EdgeId> edges = reconstruction.skeleton.Edges();
  // The second edge was not measured; a fourth was, but is no part of the result any more.
  reconstruction.radii.edges = {
      {edges[0], 0.002, 0.0001, 12}, {edges[2], 0.003, 0.0002, 9}, {edges[2] + 1, 0.009, 0, 5}};
  reconstruction.views.frames = 20;
  for (const EdgeId edge : edges) {
    reconstruction.views.edges.push_back({edge, {{10, 7}, {8 - edge, 5 - edge}}});
  }
  const auto skeleton = nlohmann::json::parse(ReportJson(run.Record()))["skeleton"];
  EXPECT_EQ(skeleton["images_looked_through"], 20);
  ASSERT_EQ(skeleton["per_edge"].size(), 3u);
  EXPECT_NEAR(skeleton["per_edge"][0]["diameter_error_mm"], 0.2, 1e-12);
  EXPECT_EQ(skeleton["per_edge"][0]["strips"], 12);
  EXPECT_TRUE(skeleton["per_edge"][1]["diameter_error_mm"].is_null());
  EXPECT_EQ(skeleton["per_edge"][1]["strips"], 0);
  EXPECT_EQ(skeleton["per_edge"][2]["strips"], 9);
  EXPECT_EQ(skeleton["per_edge"][2]["images"]["looked"], 10);
  ASSERT_EQ(skeleton["per_junction"].size(), 1u);
  EXPECT_EQ(skeleton["per_junction"][0]["degree"], 3);
  EXPECT_EQ(skeleton["per_junction"][0]["position"], nlohmann::json({0.0, 0.0, 0.0}));
  EXPECT_EQ(skeleton["per_junction"][0]["images"]["seen"], 7);
}

TEST(Report, HoldsWhatEveryRuleTook) {
  YRun run;
  run.reconstruction.funnel.points.merged_points = 34'063;
  run.reconstruction.funnel.points.unverified = 34'017;
  run.reconstruction.funnel.points.too_few_frames = 40;
  const auto funnel = nlohmann::json::parse(ReportJson(run.Record()))["funnel"];
  EXPECT_EQ(funnel["candidate_points"], 34'063);
  EXPECT_EQ(funnel["dropped_points"]["colour_unverified"], 34'017);
  EXPECT_EQ(funnel["dropped_points"]["too_few_frames"], 40);
  EXPECT_EQ(funnel["dropped_length"]["thick"], 0);
  EXPECT_EQ(funnel["dropped_length"]["surface_edge"], 0);
}

TEST(Report, TellsHowFarAResultMayBeTrusted) {
  YRun run;
  Trust& trust = run.reconstruction.trust;
  trust.length = 3;
  trust.measured_share = 0.25;
  trust.wire_length = 1.5;
  trust.pose_shift = 0.002;
  const auto json = nlohmann::json::parse(ReportJson(run.Record()))["trust"];
  EXPECT_EQ(json["measured_diameter_share"], 0.25);
  EXPECT_EQ(json["wire_share"], 0.5);
  EXPECT_DOUBLE_EQ(json["pose_shift_mm"], 2);
  EXPECT_TRUE(json["residual_px"].is_null());
  EXPECT_EQ(json["doubts"].size(), 1u);
}

TEST(Summary, NamesFindingsFilesAndWarnings) {
  YRun run;
  const std::string summary = Summary(run.Record(), "out", "out/report.html", "out/report.json");
  EXPECT_THAT(summary, HasSubstr("3 curves, 0.30 m, diameter 4.0 to 6.0 mm, 1 junction, 3 free"));
  for (const char* file :
       {"out/skeleton.json", "out/mesh.ply", "out/preview.png", "out/report.html"}) {
    EXPECT_THAT(summary, HasSubstr(file));
  }
  EXPECT_THAT(summary, HasSubstr("warning: Two frames have no pose."));
  EXPECT_THAT(summary, HasSubstr("warning: One wire is thinner than a pixel."));
}

TEST(Summary, TellsEveryWarningOnce) {
  YRun run;
  run.reconstruction.warnings.insert(run.reconstruction.warnings.begin(), run.sequence.warnings[0]);
  const std::string summary = Summary(run.Record(), "out", "out/report.html", "out/report.json");
  const size_t first = summary.find("Two frames have no pose.");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(summary.find("Two frames have no pose.", first + 1), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(ReportJson(run.Record()))["warnings"].size(), 3u);
}

TEST(Summary, OfNothingNamesNoFilesThatAreNotThere) {
  YRun run;
  run.reconstruction.skeleton = SkeletonGraph();
  const std::string summary = Summary(run.Record(), "out", "out/report.html", "out/report.json");
  EXPECT_THAT(summary, HasSubstr("nothing thin"));
  EXPECT_THAT(summary, Not(HasSubstr("mesh.ply")));
}

}  // namespace
}  // namespace curvefusion
