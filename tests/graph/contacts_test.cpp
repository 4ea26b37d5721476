#include "graph/contacts.h"

#include <gtest/gtest.h>

#include "graph/validate.h"
#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

constexpr double kThreshold = 3 * kMillimetre;

TEST(Contacts, ACleanGraphHasNone) {
  EXPECT_TRUE(FindContacts(SkeletonGraph(), kThreshold).empty());
  EXPECT_TRUE(FindContacts(YShape(0.1), kThreshold).empty());
  EXPECT_TRUE(FindContacts(Lattice(4, 4, 0.05), kThreshold).empty());
  SkeletonGraph curves;
  curves.AddPolyline(Helix(0.03, 0.02, 3));
  curves.AddPolyline(Ring(0.05, 300, {0.2, 0, 0}));
  EXPECT_TRUE(FindContacts(curves, kThreshold).empty());
}

TEST(Contacts, ACrossingIsOneContactAtTheRightPlace) {
  SkeletonGraph graph;
  graph.AddPolyline(StraightLine({-0.05, 0, 0}, {0.05, 0, 0}));
  graph.AddPolyline(StraightLine({0.01, -0.05, 0.002}, {0.01, 0.05, 0.002}));
  const std::vector<Contact> contacts = FindContacts(graph, kThreshold);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_FALSE(contacts[0].overlap);
  EXPECT_NEAR(contacts[0].distance, 0.002, 1e-12);  // rounding only
  EXPECT_NEAR(contacts[0].closest.first.arc_length, 0.06, 1e-12);
  EXPECT_NEAR(contacts[0].closest.second.arc_length, 0.05, 1e-12);
  EXPECT_TRUE(FindContacts(graph, 0.0019).empty());
  // The limit itself counts: 2 mm apart in exact arithmetic on the stored numbers.
  EXPECT_EQ(FindContacts(graph, 0.002).size(), 1u);
}

TEST(Contacts, SamplingDoesNotMatter) {
  for (const double step : {0.2, 0.01, 0.001}) {
    SkeletonGraph graph;
    graph.AddPolyline(StraightLine({-0.05, 0, 0}, {0.05, 0, 0}, step));
    graph.AddPolyline(StraightLine({0, -0.05, 0.001}, {0, 0.05, 0.001}, step));
    graph.AddPolyline(StraightLine({-0.05, 0.03, 0.002}, {0.05, 0.03, 0.002}, step));
    EXPECT_EQ(FindContacts(graph, kThreshold).size(), 2u) << step;
    EXPECT_TRUE(FindContacts(YShape(0.1, Vec3::Zero(), step), kThreshold).empty()) << step;
  }
}

TEST(Contacts, CurvesSideBySideOverlap) {
  SkeletonGraph graph;
  graph.AddPolyline(StraightLine({0, 0, 0}, {0.1, 0, 0}));
  graph.AddPolyline(StraightLine({0.04, 0.002, 0}, {0.2, 0.002, 0}));
  const std::vector<Contact> contacts = FindContacts(graph, kThreshold);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_TRUE(contacts[0].overlap);
  // The stretch reaches as far beyond the end of the other curve as the threshold allows.
  EXPECT_NEAR(contacts[0].first.first.arc_length, 0.04, kThreshold);
  EXPECT_NEAR(contacts[0].last.second.arc_length, 0.06, kThreshold);
}

// Arms x from the node on both sides are 2 x sin(angle / 2) apart; three thresholds along each are
// excused, which is an angle of 2 asin(1 / 6) = 19 degrees.
TEST(Contacts, ForksOfMoreThanTwentyDegreesAreExcused) {
  for (const double degrees : {10.0, 15.0, 23.0, 40.0}) {
    SkeletonGraph graph;
    const NodeId node = graph.AddNode(Vec3::Zero());
    for (const double side : {-0.5, 0.5}) {
      const double angle = side * degrees * M_PI / 180;
      const Vec3 tip = 0.1 * Vec3(std::cos(angle), std::sin(angle), 0);
      Connect(graph, node, graph.AddNode(tip), StraightLine(Vec3::Zero(), tip));
    }
    EXPECT_EQ(FindContacts(graph, kThreshold).empty(), degrees > 20) << degrees;
  }
}

TEST(Contacts, ALoopTouchesItselfAHairpinIsContinuous) {
  Polyline loop = StraightLine({-0.05, 0, 0}, {0, 0, 0});
  const Polyline ring = Ring(0.004, 26, {0, 0.004, 0});  // 25 mm around, 8 mm wide
  for (size_t i = 0; i + 1 < ring.size(); ++i)
    loop.push_back(Vec3(0, 0.004, 0) +
                   Eigen::AngleAxisd(-M_PI / 2, Vec3::UnitZ()) * (ring[i] - Vec3(0, 0.004, 0)));
  const Polyline away = StraightLine({0.001, 0, 0.001}, {0.05, 0, 0.001});
  loop.insert(loop.end(), away.begin(), away.end());
  SkeletonGraph graph;
  graph.AddPolyline(loop);
  EXPECT_EQ(FindContacts(graph, kThreshold).size(), 1u);

  SkeletonGraph hairpin;
  hairpin.AddPolyline(
      {{0, 0, 0}, {0.002, 0.0, 0}, {0.0025, 0.001, 0}, {0.002, 0.002, 0}, {0, 0.002, 0}});
  EXPECT_TRUE(FindContacts(hairpin, kThreshold).empty());
}

TEST(Contacts, FreeEndsThatMeetAreAContact) {
  SkeletonGraph graph;
  graph.AddPolyline(StraightLine({0, 0, 0}, {0.05, 0, 0}));
  graph.AddPolyline(StraightLine({0.052, 0, 0}, {0.1, 0, 0}));
  EXPECT_EQ(FindContacts(graph, kThreshold).size(), 1u);
}

TEST(Validate, NamesEveryKindOfFault) {
  SkeletonGraph graph = YShape(0.1);
  EXPECT_TRUE(Violations(graph, kThreshold).empty());
  EXPECT_NO_THROW(Validate(graph, kThreshold, "Y"));

  SkeletonGraph repeated;
  repeated.AddPolyline({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}});
  EXPECT_EQ(Violations(repeated, kThreshold).size(), 1u);

  SkeletonGraph not_finite;
  not_finite.AddPolyline({{0, 0, 0}, {0, NAN, 0}, {1, 0, 0}});
  EXPECT_EQ(Violations(not_finite, kThreshold).size(), 1u);

  SkeletonGraph radius;
  radius.AddPolyline({{0, 0, 0}, {1, 0, 0}});
  radius.SetCurve(0, {{0, 0, 0}, {1, 0, 0}}, {1, 0}, {-1, 0});
  EXPECT_EQ(Violations(radius, kThreshold).size(), 2u);

  SkeletonGraph crossing;
  crossing.AddPolyline({{-1, 0, 0}, {1, 0, 0}});
  crossing.AddPolyline({{0, -1, 0}, {0, 1, 0}});
  EXPECT_EQ(Violations(crossing, 0).size(), 1u);
  EXPECT_THROW(Validate(crossing, kThreshold, "X"), std::exception);

  SkeletonGraph twice;
  twice.AddNode({0, 0, 0});
  twice.AddNode({0.01, 0, 0});
  Connect(twice, 0, 1, {{0, 0, 0}, {0.005, 0.001, 0}, {0.01, 0, 0}});
  Connect(twice, 1, 0, {{0.01, 0, 0}, {0.005, -0.001, 0}, {0, 0, 0}});
  EXPECT_EQ(Violations(twice, kThreshold).size(), 1u);
}

}  // namespace
}  // namespace curvefusion
