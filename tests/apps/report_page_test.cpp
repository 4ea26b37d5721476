#include "apps/report_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/page_curves.h"
#include "apps/page_parts.h"
#include "tests/apps/result_fixtures.h"

namespace curvefusion {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kDataElement = R"(<script type="application/json" id="data">)";

// A helix of 50 mm radius around z, beginning at a place of its own, with a point a millimetre, as
// the pipeline makes them, and thickness from 2 to 6 mm.
void AddHelix(const Vec3& start, double length, SkeletonGraph& graph) {
  Polyline points;
  std::vector<double> radii;
  const int count = static_cast<int>(length / kMillimetre);
  for (int i = 0; i <= count; ++i) {
    const double angle = i * kMillimetre / 0.05;
    points.push_back(start + Vec3(0.05 * std::cos(angle), 0.05 * std::sin(angle), 0.003 * angle));
    radii.push_back((2 + std::sin(angle / 7)) * kMillimetre);
  }
  const EdgeId edge = graph.AddPolyline(points);
  graph.SetCurve(edge, points, radii);
}

struct YRun {
  Sequence sequence;
  Config config = ProfileConfig(Profile::kBest);
  Reconstruction reconstruction;

  YRun() {
    sequence.folder = "scans/y";
    reconstruction.skeleton = Y();
  }
  std::string Page(const PagePictures& pictures = {}) const {
    const RunRecord record{sequence, config, reconstruction, std::nullopt, 10, 1000};
    return ReportPage(record, pictures, {"skeleton.json", "report.json"});
  }
};

// What a browser takes for the data: the text up to the first end of a script.
json DataOf(const std::string& page) {
  const size_t begin = page.find(kDataElement) + std::string(kDataElement).size();
  return json::parse(page.substr(begin, page.find("</script", begin) - begin));
}

TEST(ReportPage, HoldsTheSkeletonAndTheReport) {
  const YRun run;
  const std::string page = run.Page();
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_TRUE(page.ends_with("</html>\n"));
  const json data = DataOf(page);
  EXPECT_EQ(data["title"], "y");
  EXPECT_TRUE(data["nothing_found"].is_null());
  EXPECT_EQ(data["curves"]["nodes"].size(), 4u);
  ASSERT_EQ(data["curves"]["edges"].size(), 3u);
  const json& third = data["curves"]["edges"][2];
  EXPECT_EQ(third["points"], json({0, 0, 0, 0, 0, 100}));  // millimetres
  EXPECT_EQ(third["radii"], json({3.0}));
  EXPECT_EQ(third["nodes"], json({0, 3}));
  const RunRecord record{run.sequence, run.config, run.reconstruction, std::nullopt, 10, 1000};
  EXPECT_EQ(data["report"], json::parse(ReportJson(record)));
  EXPECT_EQ(data["files"], json({"skeleton.json", "report.json"}));
}

TEST(ReportPage, NoTextEndsItsElementOrTheData) {
  YRun run;
  const std::string evil = "</script><!--<script>alert(\"&\")\\ \x01 \xe2\x80\xa8";
  run.sequence.folder = "scans/" + evil.substr(10);
  run.reconstruction.warnings = {evil};
  const std::string page = run.Page();
  const json data = DataOf(page);
  EXPECT_EQ(data["report"]["warnings"][0], evil);
  EXPECT_EQ(data["report"]["sequence"]["folder"], "scans/" + evil.substr(10));
  const size_t begin = page.find(kDataElement) + std::string(kDataElement).size();
  // What follows the data is in every page.
  const std::string empty = AssemblePage("report.html", "");
  const size_t behind = empty.size() - empty.find(kDataElement) - std::string(kDataElement).size();
  EXPECT_THAT(page.substr(begin, page.size() - behind - begin), Not(HasSubstr("<")));
}

TEST(ReportPage, NamesThatAreNoUtf8AreReplaced) {
  YRun run;
  run.sequence.folder = "scans/caf\xe9";
  EXPECT_EQ(DataOf(run.Page())["title"], "caf\xef\xbf\xbd");
}

TEST(ReportPage, NeedsNothingFromElsewhere) {
  const std::string page = YRun().Page();
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  for (const char* loader : {"src=\"http", "href=\"http", "url(", "@import"}) {
    // three.js has such words of its own.
    EXPECT_THAT(page.substr(0, page.find(kDataElement)), Not(HasSubstr(loader))) << loader;
  }
  for (const char* left : {"{{data}}", "{{style.css}}", "{{page.js}}", "{{viewer.js}}"}) {
    EXPECT_THAT(page, Not(HasSubstr(left)));
  }
}

TEST(ReportPage, IsTheSameEveryTime) {
  const YRun run;
  EXPECT_EQ(run.Page(), run.Page());
}

TEST(ReportPage, TellsSettingsThatAreNotTheDefaults) {
  YRun run;
  EXPECT_TRUE(DataOf(run.Page())["settings"].empty());
  run.config = ReadConfig({Profile::kPaper, "", {"volume.voxel_size=0.006"}});
  const json settings = DataOf(run.Page())["settings"];
  ASSERT_EQ(settings.size(), 1u);
  EXPECT_EQ(settings[0]["name"], "volume.voxel_size");
  EXPECT_EQ(settings[0]["value"], "0.006");
  EXPECT_EQ(settings[0]["initial"], "0.005");
  EXPECT_EQ(settings[0]["unit"], "m");
}

TEST(ReportPage, OfNothingTellsWhy) {
  YRun run;
  run.reconstruction.skeleton = SkeletonGraph();
  run.reconstruction.funnel.points.depth_pixels = 10;
  run.reconstruction.uncertain.graph = Y();
  const json data = DataOf(run.Page());
  EXPECT_EQ(data["nothing_found"], "none of 10 depth pixels lies in front of the large surfaces");
  EXPECT_TRUE(data["curves"]["edges"].empty());
  EXPECT_EQ(data["uncertain"]["edges"].size(), 3u);
}

TEST(ReportPage, IsSmallForLargeResults) {
  YRun run;
  // 2,000 curves and 600 m of wire, a hundred times the demo's.
  for (int i = 0; i < 2000; ++i) {
    AddHelix({0.2 * (i % 50), 0.2 * (i / 50), 0}, 0.3, run.reconstruction.skeleton);
  }
  EXPECT_LT(run.Page().size(), 8'000'000u);
}

TEST(PageCurves, AreDrawnWithinTheTolerance) {
  SkeletonGraph graph;
  AddHelix({1, 2, 3}, 1.0, graph);
  const SkeletonEdge& edge = graph.edge(graph.Edges()[0]);
  const json drawn = json::parse(DrawnCurves(graph, 0.2 * kMillimetre).dump());
  const json& numbers = drawn["edges"][0]["points"];
  const json& radii = drawn["edges"][0]["radii"];
  Polyline points;
  for (size_t i = 0; i < numbers.size(); i += 3) {
    points.push_back(kMillimetre * Vec3(numbers[i], numbers[i + 1], numbers[i + 2]));
  }
  EXPECT_LT(points.size(), edge.points.size() / 4);
  ASSERT_EQ(radii.size(), points.size());
  const double rounding = 0.01 * kMillimetre;  // of each coordinate
  for (const Vec3& p : edge.points) {
    EXPECT_LT(Project(points, p).distance, 0.2 * kMillimetre + rounding);
  }
  EXPECT_LT((points.front() - edge.points.front()).norm(), rounding);
  EXPECT_LT((points.back() - edge.points.back()).norm(), rounding);
}

TEST(PageCurves, TheToleranceGrowsWithTheNumberOfPoints) {
  SkeletonGraph graph;
  AddHelix({0, 0, 0}, 1.0, graph);
  EXPECT_DOUBLE_EQ(DrawingTolerance(graph, {}, 1000), 0.2 * kMillimetre);
  const double coarse = DrawingTolerance(graph, graph, 100);
  EXPECT_GT(coarse, 0.2 * kMillimetre);
  EXPECT_LE(2 * DrawnCurves(graph, coarse)["edges"][0]["points"].size() / 3, 100u);
  // A curve needs two points whatever the tolerance is.
  EXPECT_DOUBLE_EQ(DrawingTolerance(graph, {}, 1), 12.8 * kMillimetre);
  EXPECT_TRUE(DrawnCurves({}, 0.001)["edges"].empty());
}

class PageFrames : public FiveViews {};

TEST_F(PageFrames, EveryStretchGivesTheFrameThatSeesMost) {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, -0.1}, {0, 0, 0.1}});
  Sequence sequence = sequence_;
  sequence.frames[1].T_world_camera.translation() += Vec3(9, 0, 0);
  sequence.frames[2].T_world_camera.translation() += Vec3(9, 0, 0);
  EXPECT_EQ(ShownFrames(graph, sequence, 2)[0], 0);
  sequence.frames[0].T_world_camera.translation() += Vec3(9, 0, 0);
  sequence.frames[1].T_world_camera = sequence_.frames[1].T_world_camera;
  EXPECT_EQ(ShownFrames(graph, sequence, 2)[0], 1);
  EXPECT_EQ(ShownFrames(graph, sequence, 20), std::vector<int>({0, 1, 2, 3, 4}));
  sequence.frames.clear();
  EXPECT_TRUE(ShownFrames(graph, sequence, 2).empty());
}

TEST_F(PageFrames, ProjectAsTheSequenceDoes) {
  const json frame = json::parse(FrameJson(MakePageFrame(sequence_, 3)).dump());
  const Vec3 p(0.02, -0.03, 0.05);
  const Vec3 p_camera =
      sequence_.T_color_depth * (sequence_.frames[3].T_world_camera.inverse() * p);
  Vec3 from_json;
  for (int row = 0; row < 3; ++row) {
    const json& values = frame["T_camera_world"][row];
    from_json[row] = values[3];
    for (int k = 0; k < 3; ++k) from_json[row] += values[k].get<double>() * p[k] / kMillimetre;
  }
  // The pose is rounded to a hundredth of a millimetre.
  EXPECT_LT((from_json - p_camera / kMillimetre).norm(), 0.02);
  EXPECT_EQ(frame["width"], sequence_.color_camera.width);
  EXPECT_NEAR(frame["fx"], sequence_.color_camera.fx, 0.01);
  EXPECT_TRUE(frame["image"].get<std::string>().starts_with("data:image/jpeg;base64,/9j/"));
}

TEST_F(PageFrames, WidePicturesAreReduced) {
  const ColorImage wide(1280, 720, {10, 20, 30});
  const ColorImage narrow(640, 360, {10, 20, 30});
  EXPECT_EQ(JpegUrl(wide, 640), JpegUrl(narrow, 640));
  EXPECT_EQ(JpegUrl(narrow, 1000), JpegUrl(narrow, 640));
  EXPECT_EQ(JpegUrl({}, 640), "");
  // Base64 has four characters for every three bytes, the last with one or two "=".
  EXPECT_EQ((JpegUrl(narrow, 640).size() - std::string("data:image/jpeg;base64,").size()) % 4, 0u);
}

}  // namespace
}  // namespace curvefusion
