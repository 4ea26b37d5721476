#include "fusion/nets/net_wires.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fusion/segmentation/segmentation.h"
#include "tests/fusion/nets/net_before_wall.h"

namespace curvefusion {
namespace {

TEST(NetWires, WiresOfANetThatDepthShowsAsASurfaceAreFound) {
  const NetBefore net(1.2);
  const Nets nets = FindNets(net.sequence());
  ASSERT_FALSE(nets.empty());
  EXPECT_NEAR(nets.spacing, kSpacing, 0.2 * kSpacing);
  int found = 0, on_wire = 0;
  double off_depth = 0;
  for (const NetWires& wires : FindNetWires(net.sequence(), 0, 12, nets)) {
    for (int v = 0; v < wires.mask.height(); ++v) {
      for (int u = 0; u < wires.mask.width(); ++u) {
        if (!wires.mask(u, v)) continue;
        const Vec3 p =
            wires.T_world_camera * kCamera.Unproject(u, v, static_cast<double>(wires.depth(u, v)));
        off_depth += std::abs(p.z() - kNetDepth);
        ++found;
        on_wire += IsOnWire(p.x(), p.y(), kWire / 2 + 0.001);
      }
    }
  }
  EXPECT_GT(found, 20000);
  EXPECT_GT(on_wire, 0.9 * found);
  EXPECT_LT(off_depth, 0.004 * found);  // by steps of 2 mm
}

// In a volume of nothing, so that depth shows nothing thin.
TEST(NetWires, BundlesHoldThem) {
  const NetBefore net(1.2);
  SegmentationOptions options;
  options.difference.accept_where_nothing_rendered = false;
  SegmentationModel model;
  const TsdfVolume volume{TsdfOptions{}};
  const auto segment = [&] {
    return SegmentBundle(net.sequence(), 0, 12, volume, model, options, [] {});
  };
  EXPECT_TRUE(segment().points.empty());
  model.nets = FindNets(net.sequence());
  const SegmentedBundle bundle = segment();
  EXPECT_GT(bundle.points.size(), 2000u);
  EXPECT_EQ(bundle.frames.size(), 12u);
  for (const Vec3& p : bundle.points.positions) EXPECT_NEAR(p.z(), kNetDepth, 0.01);
}

TEST(NetWires, ANetPaintedOnASurfaceIsNone) {
  EXPECT_TRUE(FindNets(NetBefore(kNetDepth).sequence()).empty());
}

TEST(NetWires, FewFramesTellNothing) {
  const NetBefore net(1.2);
  Sequence sequence = net.sequence();
  sequence.frames.resize(3);
  EXPECT_TRUE(FindNets(sequence).empty());
}

}  // namespace
}  // namespace curvefusion
