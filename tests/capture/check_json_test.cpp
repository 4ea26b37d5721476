#include "capture/check_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace curvefusion {
namespace {

TEST(CheckJson, HoldsFiguresAndFindings) {
  CheckReport report;
  report.format = "tum";
  report.frames = 120;
  report.image_sizes = {640, 480, 1280, 960};
  report.depth_scale = 5000;
  report.median_depth = 0.8;
  report.findings = {{Severity::kError, "the poses are inverted", "poses-inverted"},
                     {Severity::kWarning, "dark \"images\"\n\xff"},
                     {Severity::kWarning, "", "pose-jump"},
                     {Severity::kWarning, "", "poses-late"}};
  report.geometry.mistakes = {{"pose-jump", {{"000007", "000008"}}},
                              {"poses-late", {}, MistakeAmount{-2, "frames"}}};
  const auto json = nlohmann::json::parse(CheckJson(report));
  EXPECT_EQ(json["usable"], false);
  EXPECT_EQ(json["sequence_format"], "tum");
  EXPECT_EQ(json["figures"]["frames"], 120);
  EXPECT_EQ(json["figures"]["depth_size"]["width"], 640);
  EXPECT_EQ(json["figures"]["color_size"]["height"], 960);
  EXPECT_EQ(json["figures"]["depth_scale"], 5000);
  EXPECT_TRUE(json["figures"]["duration"].is_null());
  ASSERT_EQ(json["findings"].size(), 4u);
  EXPECT_EQ(json["findings"][0]["severity"], "error");
  EXPECT_EQ(json["findings"][0]["cause"], "poses-inverted");
  EXPECT_EQ(json["findings"][0]["message"], "the poses are inverted");
  EXPECT_EQ(json["findings"][1]["severity"], "warning");
  EXPECT_TRUE(json["findings"][1]["cause"].is_null());
  EXPECT_TRUE(json["findings"][1]["frames"].empty());
  EXPECT_TRUE(json["findings"][1]["amount"].is_null());
  EXPECT_EQ(json["findings"][2]["frames"][0]["last"], "000008");
  EXPECT_EQ(json["findings"][3]["amount"]["value"], -2);
  EXPECT_EQ(json["findings"][3]["amount"]["unit"], "frames");
}

TEST(CheckJson, TellsTheFittedColourCamera) {
  CheckReport report;
  EXPECT_TRUE(nlohmann::json::parse(CheckJson(report))["colour_fit"].is_null());
  report.colour_camera.measured = true;
  report.colour_camera.displacement_px = 27;
  report.colour_camera.color_camera = {640, 480, 538, 538, 318, 239};
  report.colour_camera.T_color_depth.translation().x() = -0.026;
  const auto fit = nlohmann::json::parse(CheckJson(report))["colour_fit"];
  EXPECT_EQ(fit["is_misregistered"], false);  // no share of edges
  EXPECT_EQ(fit["displacement_px"], 27);
  EXPECT_EQ(fit["color_camera"]["fx"], 538);
  EXPECT_EQ(fit["T_color_depth"][0][3], -0.026);
}

TEST(CheckJson, OfNothingIsStillAnObject) {
  const auto json = nlohmann::json::parse(CheckJson({}));
  EXPECT_EQ(json["usable"], true);
  EXPECT_TRUE(json["sequence_format"].is_null());
  EXPECT_TRUE(json["findings"].empty());
}

}  // namespace
}  // namespace curvefusion
