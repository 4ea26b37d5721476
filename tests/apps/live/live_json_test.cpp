#include "apps/live/live_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace curvefusion {
namespace {

using nlohmann::json;

// Three straight curves of 100, 50 and 20 mm, seen from one side alone.
LiveSnapshot ThreeCurves() {
  LiveSnapshot snapshot;
  for (const double length : {0.05, 0.1, 0.02}) {
    snapshot.graph.AddPolyline({Vec3(0, length, 0), Vec3(length, length, 0)});
    CurveSightings seen;
    seen.frames = 15;
    seen.spread = 0.5236;  // 30 degrees
    seen.evidence = 0.5;
    seen.free_ends = {true, true};
    seen.at = Vec3(length / 2, length, 0);
    seen.look_from = Vec3::UnitZ();
    snapshot.curves.push_back(seen);
  }
  return snapshot;
}

TEST(LiveJson, HintsNameTheLongestUnknownCurvesFirst) {
  const json curves = CurvesJson(ThreeCurves(), 2, {});
  EXPECT_EQ(curves["number"], 2);
  EXPECT_EQ(curves["curves"]["edges"].size(), 3);
  ASSERT_EQ(curves["hints"].size(), 2);  // 20 mm are too short for one
  EXPECT_EQ(curves["hints"][0]["curve"], 1);
  EXPECT_EQ(curves["hints"][0]["at"], json({50, 100, 0}));
  EXPECT_EQ(curves["hints"][0]["from"], json({0, 0, 1}));
  EXPECT_EQ(curves["hints"][1]["curve"], 0);
  EXPECT_EQ(curves["figures"][1]["spread_degrees"], 30);
  EXPECT_EQ(curves["figures"][1]["length_mm"], 100);
}

TEST(LiveJson, CurvesThatWereSeenFromEnoughSidesHaveNoHint) {
  LiveSnapshot snapshot = ThreeCurves();
  for (CurveSightings& seen : snapshot.curves) seen.look_from.setZero();
  EXPECT_TRUE(CurvesJson(snapshot, 1, {})["hints"].empty());
  EXPECT_TRUE(SightingsJson(snapshot)[0]["look_from"].is_null());
}

TEST(LiveJson, TheCurvesOfAnEmptySnapshotAreEmpty) {
  const json curves = CurvesJson({}, 1, {});
  EXPECT_TRUE(curves["curves"]["edges"].empty());
  EXPECT_TRUE(curves["hints"].empty());
}

}  // namespace
}  // namespace curvefusion
