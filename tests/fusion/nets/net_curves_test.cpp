#include "fusion/nets/net_curves.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fusion/best/net_stage.h"
#include "fusion/nets/net_sheets.h"
#include "fusion/nets/net_wires.h"
#include "fusion/nets/sheet_views.h"
#include "graph/validate.h"
#include "tests/fusion/nets/net_before_wall.h"

namespace curvefusion {
namespace {

class NetCurvesTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    net_ = new NetBefore(1.2, 0.7);
    nets_ = new Nets(FindNets(net_->sequence()));
  }
  static void TearDownTestSuite() {
    delete nets_;
    delete net_;
  }

  static NetBefore* net_;
  static Nets* nets_;
};

NetBefore* NetCurvesTest::net_ = nullptr;
Nets* NetCurvesTest::nets_ = nullptr;

double OffWire(const Vec3& p) {
  const auto off = [](double x) { return std::abs(x - kSpacing * std::round(x / kSpacing)); };
  return std::min(off(p.x()), off(p.y()));
}

// 17 by 13 wires, a part of which the border of the opening hides.
TEST_F(NetCurvesTest, EveryWireIsTracedThroughAllCrossings) {
  SkeletonGraph skeleton;
  const NetCurves curves = AddNetCurves(net_->sequence(), *nets_, 0.001, skeleton);
  EXPECT_EQ(curves.replaced, 0);
  EXPECT_GT(curves.length, 0.85 * (17 * 0.16 + 13 * 0.2));
  int junctions = 0;
  for (const NodeId node : skeleton.Nodes()) junctions += skeleton.Degree(node) > 2;
  EXPECT_GT(junctions, 0.85 * 17 * 13);
  EXPECT_TRUE(Violations(skeleton, 0).empty());
  double length = 0, on_wire = 0;
  for (const EdgeId id : skeleton.Edges()) {
    for (const Vec3& p : skeleton.edge(id).points) {
      length += 1;
      on_wire += OffWire(p) < 0.001 && std::abs(p.z() - kNetDepth) < 0.003;
    }
  }
  EXPECT_GT(on_wire, 0.95 * length);
}

TEST_F(NetCurvesTest, TheyAreMeasured) {
  SkeletonGraph skeleton;
  const NetCurves curves = AddNetCurves(net_->sequence(), *nets_, 0.001, skeleton);
  size_t measured = 0;
  for (const NetWire& wire : curves.wires)
    measured += std::abs(wire.diameter - kWire) < 0.2 * kWire;
  EXPECT_GT(measured, 0.8 * static_cast<double>(curves.wires.size()));  // not beside the board
  Reconstruction result;
  result.skeleton = skeleton;
  for (const EdgeId id : skeleton.Edges()) result.radii.edges.push_back({.edge = id});
  const EdgeId last = result.radii.edges.back().edge;
  result.radii.edges.back().radius = 0.01;
  MeasureNetWires(curves, result);
  EXPECT_NEAR(result.radii.global_radius, 0.5 * kWire, 0.1 * kWire);
  for (const EdgeRadius& edge : result.radii.edges) {
    EXPECT_GT(edge.radius, 0);
    EXPECT_EQ(edge.radius == 0.01, edge.edge == last);  // was measured already
  }
}

TEST_F(NetCurvesTest, TheyReplaceWhatRunsAcrossTheNetButNotWhatLiesBeforeIt) {
  SkeletonGraph skeleton;
  const auto diagonal = [&](double z) {
    Polyline points;
    for (int i = 0; i <= 60; ++i) points.emplace_back(-0.06 + 0.002 * i, -0.04 + 0.001 * i, z);
    skeleton.AddPolyline(points);
    return Length(points);
  };
  const double on_net = diagonal(kNetDepth);
  const double before = diagonal(kNetDepth - 0.05);
  const NetCurves curves = AddNetCurves(net_->sequence(), *nets_, 0.001, skeleton);
  EXPECT_NEAR(curves.replaced, on_net, 0.1 * on_net);
  double left = 0;
  for (const EdgeId id : skeleton.Edges()) {
    const Polyline& points = skeleton.edge(id).points;
    if (points.front().z() < kNetDepth - 0.03) left += Length(points);
  }
  EXPECT_NEAR(left, before, 1e-9);
}

TEST_F(NetCurvesTest, WithoutNetsNothingChanges) {
  SkeletonGraph skeleton;
  EXPECT_TRUE(AddNetCurves(net_->sequence(), {}, 0.001, skeleton).wires.empty());
  EXPECT_TRUE(skeleton.empty());
}

// Cells of a net where there is only a wall, say of a scan's other nets.
TEST_F(NetCurvesTest, AWallGivesNoWires) {
  const NetBefore painted(kNetDepth);
  SkeletonGraph skeleton;
  EXPECT_TRUE(AddNetCurves(painted.sequence(), *nets_, 0.001, skeleton).wires.empty());
  EXPECT_TRUE(skeleton.empty());
}

// Looks of a sheet, and how many of them are at something black.
struct Looks {
  int all = 0;
  int black = 0;
};

Looks LookPast(const SkeletonGraph& skeleton, const Sequence& sequence, const NetSheet& sheet) {
  Looks looks;
  const std::vector<SheetView> views = ViewsOfSheet(sequence, skeleton, sheet);
  for (const SheetLook& look : LookAt(sequence, views, SheetPixels(sheet, 0.002), Vec3::Zero())) {
    for (size_t i = 0; i < look.size(); ++i) {
      looks.all += look.data()[i][3];
      looks.black += look.data()[i][3] != 0 && look.data()[i][0] < 20;
    }
  }
  return looks;
}

// The bars of NetBefore, but so far away.
SkeletonGraph BarsAt(double depth) {
  SkeletonGraph bars;
  for (int i = -8; i <= 8; ++i) {
    const double off = kBarSpacing * i;
    for (const Polyline& ends : {Polyline{{-0.2, off, depth}, {0.2, off, depth}},
                                 Polyline{{off, -0.2, depth}, {off, 0.2, depth}}}) {
      const Polyline points = Resample(ends, 0.003);
      bars.SetCurve(bars.AddPolyline(points), points, std::vector<double>(points.size(), kBar / 2));
    }
  }
  return bars;
}

// Through bars that depth does not show a wall would change from view to view as a net does.
TEST_F(NetCurvesTest, KnownCurvesBeforeASheetAreNotTakenForIt) {
  const NetBefore wall(kNetDepth, 0.7, Before::kBlackBars);
  const std::vector<NetSheet> sheets = SheetsOf(wall.sequence(), *nets_);
  ASSERT_FALSE(sheets.empty());
  const Looks unknown = LookPast({}, wall.sequence(), sheets[0]);
  const Looks before = LookPast(BarsAt(kBarsDepth), wall.sequence(), sheets[0]);
  const Looks behind = LookPast(BarsAt(kNetDepth + 0.1), wall.sequence(), sheets[0]);
  EXPECT_GT(unknown.black, 0.05 * unknown.all);
  EXPECT_EQ(before.black, 0);
  EXPECT_GT(before.all, 0.2 * unknown.all);
  EXPECT_EQ(behind.all, unknown.all);
}

}  // namespace
}  // namespace curvefusion
