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
                     {Severity::kWarning, "dark \"images\"\n\xff"}};
  const auto json = nlohmann::json::parse(CheckJson(report));
  EXPECT_EQ(json["usable"], false);
  EXPECT_EQ(json["sequence_format"], "tum");
  EXPECT_EQ(json["figures"]["frames"], 120);
  EXPECT_EQ(json["figures"]["depth_size"]["width"], 640);
  EXPECT_EQ(json["figures"]["color_size"]["height"], 960);
  EXPECT_EQ(json["figures"]["depth_scale"], 5000);
  EXPECT_TRUE(json["figures"]["duration"].is_null());
  ASSERT_EQ(json["findings"].size(), 2u);
  EXPECT_EQ(json["findings"][0]["severity"], "error");
  EXPECT_EQ(json["findings"][0]["cause"], "poses-inverted");
  EXPECT_EQ(json["findings"][0]["message"], "the poses are inverted");
  EXPECT_EQ(json["findings"][1]["severity"], "warning");
  EXPECT_TRUE(json["findings"][1]["cause"].is_null());
}

TEST(CheckJson, OfNothingIsStillAnObject) {
  const auto json = nlohmann::json::parse(CheckJson({}));
  EXPECT_EQ(json["usable"], true);
  EXPECT_TRUE(json["sequence_format"].is_null());
  EXPECT_TRUE(json["findings"].empty());
}

}  // namespace
}  // namespace curvefusion
