#include "experiments/simulation/families/scan_draw.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "experiments/metrics/truth.h"
#include "experiments/simulation/drift.h"
#include "experiments/simulation/scan_settings.h"
#include "kernel/error.h"
#include "tests/error_message.h"
#include "tests/file_contents.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

TEST(DrawScan, TakesAnotherCameraOfTheSameThing) {
  const SimulationOptions drawn = DrawScan("cage", 11), phone = DrawScan("cage", 11, "phone");
  EXPECT_EQ(phone.sensor, "phone");
  EXPECT_EQ(phone.pose_source, "arkit");
  EXPECT_EQ(phone.color.registration, Registration::kRegistered);
  EXPECT_LE(phone.registration_error_px, 0.5);
  EXPECT_GE(phone.motion.standoff, 0.35);
  EXPECT_LE(phone.motion.standoff, 0.6);
  SimulationOptions same = DrawScan("cage", 11, "d455");
  EXPECT_EQ(same.pose_source, drawn.pose_source);
  same.sensor = drawn.sensor;
  same.motion.standoff = drawn.motion.standoff;
  EXPECT_EQ(ScanSettings(same), ScanSettings(drawn));
  EXPECT_THROW(DrawScan("cage", 11, "ideal"), Error);
}

TEST(DrawScan, KeepsItsRangesAndIsGivenByItsSeed) {
  std::set<std::string> sensors;
  int long_scans = 0;
  for (const std::string& family : FamilyNames()) {
    for (uint64_t seed = 1; seed <= 20; ++seed) {
      const SimulationOptions scan = DrawScan(family, seed);
      EXPECT_GE(scan.frames, 60);
      EXPECT_LE(scan.frames, 400);
      // A row is not read for longer than a frame lasts: SimulateScan would refuse that.
      EXPECT_LE(scan.readout_time * scan.motion.frame_rate, 1);
      EXPECT_LE(scan.scene.wire_albedo, 0.95);
      EXPECT_EQ(ScanSettings(scan), ScanSettings(DrawScan(family, seed)));
      EXPECT_NE(ScanSettings(scan), ScanSettings(DrawScan(family, seed + 1)));
      sensors.insert(scan.sensor);
      long_scans += scan.frames > 200;
    }
  }
  EXPECT_EQ(sensors.size(), 6u);
  EXPECT_GT(long_scans, 0);
}

TEST(DrawScan, OneScanInSevenHasThePosesOfTheKitchen) {
  std::map<std::string, int> scans;
  for (const std::string& family : FamilyNames()) {
    for (uint64_t seed = 1; seed <= 60; ++seed) ++scans[DrawScan(family, seed).pose_source];
  }
  int total = 0;
  for (const auto& [source, count] : scans) total += count;
  EXPECT_EQ(scans.size(), PoseSourceNames().size() - 1);  // all but a phone's own
  // .15 within three standard deviations of that share of 1,080 scans.
  EXPECT_NEAR(static_cast<double>(scans["kitchen"]) / total, 0.15, 0.033);
}

// Scans that others have measured keep their poses, but for those that now have the kitchen's.
TEST(DrawScan, PosesDrawnBeforeTheKitchenCameStay) {
  struct Drawn {
    const char* family;
    uint64_t seed;
    const char* source;
    double scale;
  };
  int kept = 0;
  for (const Drawn& before : {Drawn{"cage", 2, "kinfu", 1.0280595910988788},
                              Drawn{"chair", 1, "bundlefusion", 0.62345375482976},
                              Drawn{"knot", 1, "orbslam2", 1.583129168061275},
                              Drawn{"stand", 1, "bundlefusion", 1.3504911377184634},
                              Drawn{"tree", 2, "orbslam2", 1.1765313133575117},
                              Drawn{"vine", 1, "ptam", 0.6154582139319035}}) {
    const SimulationOptions scan = DrawScan(before.family, before.seed);
    EXPECT_DOUBLE_EQ(scan.pose_error_scale, before.scale) << before.family;
    if (scan.pose_source == "kitchen") continue;
    EXPECT_EQ(scan.pose_source, before.source) << before.family;
    ++kept;
  }
  EXPECT_GE(kept, 4);
}

TEST(DrawScan, RoomsHaveNoWireAndFurnishedOnesBoth) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const SimulationOptions room = DrawScan("room", seed);
    const SimulationOptions furnished = DrawScan("furnished", seed);
    const Scene empty = MakeScene(MakeObject(room.object, room.object_options), room.scene, seed);
    EXPECT_TRUE(empty.object.curves.empty());
    EXPECT_GE(room.scene.furniture, 12);
    EXPECT_GE(furnished.scene.furniture, 12);
    const Scene scene =
        MakeScene(MakeObject(furnished.object, furnished.object_options), furnished.scene, seed);
    EXPECT_FALSE(scene.object.curves.empty());
    EXPECT_EQ(ColorContrast(empty), 0);
    EXPECT_GT(ColorContrast(scene), 0);
    EXPECT_LT(ColorContrast(scene), 1);
  }
}

TEST(DrawScan, UnknownFamilyIsRefusedWithTheNearest) {
  EXPECT_THAT(MessageOf(ErrorKind::kUsage, [] { DrawScan("rooms", 1); }),
              testing::HasSubstr("room?"));
}

TEST(ScanSettings, SimulateTheSameScanAgain) {
  const TemporaryFolder folder("scan_settings");
  SimulationOptions scan = DrawScan("vine", 3);
  scan.sensor = "ideal";
  scan.frames = 2;
  SimulateScan(scan, folder / "first", NoProgress);
  SimulateScan(ReadScanSettings(folder / "first" / "truth" / "settings.json"), folder / "second",
               NoProgress);
  EXPECT_TRUE(FileContents(folder / "first") == FileContents(folder / "second"));
}

TEST(ScanSettings, RoomHasATruthWithoutCurves) {
  const TemporaryFolder folder("scan_settings_room");
  SimulationOptions scan = DrawScan("room", 3);
  scan.sensor = "ideal";
  scan.frames = 1;
  SimulateScan(scan, folder / "scan", NoProgress);
  EXPECT_TRUE(ReadTruth(folder / "scan" / "truth").empty());
}

TEST(ScanSettings, RegistrationAndLightReadBack) {
  SimulationOptions scan;
  scan.color.registration = Registration::kRaw;
  scan.scene.light = LightKind::kSide;
  scan.scene.table_gap = 0.005;
  const fs::path file = TemporaryPath("scan_settings_color.json");
  std::ofstream(file) << ScanSettings(scan);
  const SimulationOptions read = ReadScanSettings(file);
  EXPECT_EQ(read.color.registration, Registration::kRaw);
  EXPECT_EQ(read.scene.light, LightKind::kSide);
  EXPECT_EQ(read.scene.table_gap, 0.005);
  fs::remove(file);
}

TEST(ScanSettings, RefusesWhatTellsOfNoScan) {
  const fs::path file = TemporaryPath("scan_settings.json");
  const auto message_of = [&](const std::string& text) {
    std::ofstream(file) << text;
    return MessageOf(ErrorKind::kBadInput, [&] { ReadScanSettings(file); });
  };
  std::string text = ScanSettings(SimulationOptions());
  std::ofstream(file) << text;
  EXPECT_NO_THROW(ReadScanSettings(file));
  EXPECT_NE(message_of("{}").find("no simulated scan"), std::string::npos);
  EXPECT_NE(message_of("{\"simulator\":0}").find("version 0"), std::string::npos);
  text.replace(text.find("\"frames\":150"), 12, "\"frames\":0");
  EXPECT_NE(message_of(text).find("frames = 0"), std::string::npos);
  fs::remove(file);
}

}  // namespace
}  // namespace curvefusion
