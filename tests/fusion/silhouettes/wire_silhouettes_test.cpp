#include "fusion/silhouettes/wire_silhouettes.h"

#include <gtest/gtest.h>

#include "tests/fusion/silhouettes/silhouette_scan.h"

namespace curvefusion {
namespace {

const Polyline kWire = TestLine({-0.06, 0, 0}, {0.06, 0, 0});

TEST(WireSilhouettes, SeeAWireInAllImages) {
  const SilhouetteScan scan({kWire});
  const ViewCount count = scan.Silhouettes().Count({0.02, 0, 0});
  EXPECT_EQ(count.looked, 24);
  EXPECT_EQ(count.seen, 24);
}

TEST(WireSilhouettes, SeeAWireBehindAnother) {
  // Straight behind the first for the cameras in the middle.
  const SilhouetteScan scan({kWire, TestLine({-0.06, 0, 0.02}, {0.06, 0, 0.02})});
  EXPECT_EQ(scan.Silhouettes().Share({0.01, 0, 0.02}), 1);
}

TEST(WireSilhouettes, LookPastWhatIsNoWire) {
  const SilhouetteScan scan({kWire});
  const WireSilhouettes silhouettes = scan.Silhouettes();
  // Beside the wire as all cameras see it.
  EXPECT_EQ(silhouettes.Share({0, 0.012, 0}), 0);
  // Behind it: cameras that look from above and below see past.
  EXPECT_LT(silhouettes.Share({0, 0, 0.03}), 0.5);
}

TEST(WireSilhouettes, LeaveOutWhatIsHidden) {
  const SilhouetteScan scan({kWire}, {}, 0.4);
  const ViewCount beside = scan.Silhouettes().Count({0, 0.012, 0});
  EXPECT_EQ(beside.looked, 0);
  EXPECT_EQ(scan.Silhouettes().Count({0, 0, 0}).seen, 24);
}

TEST(WireSilhouettes, KnowNothingOutsideTheImages) {
  const SilhouetteScan scan({kWire});
  const WireSilhouettes silhouettes = scan.Silhouettes();
  EXPECT_EQ(silhouettes.Count({0, 3, 0}).looked, 0);
  EXPECT_EQ(silhouettes.Share({0, 3, 0}), 0);  // too few looks to tell
  EXPECT_EQ(silhouettes.Share({0, 3, 0}, 1), 1);
}

}  // namespace
}  // namespace curvefusion
