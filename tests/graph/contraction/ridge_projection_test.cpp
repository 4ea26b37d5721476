#include "graph/contraction/ridge_projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "kernel/parallel.h"
#include "tests/graph/noisy_wires.h"

namespace curvefusion {
namespace {

const Polyline kWire{{0, 0, 0}, {0.1, 0, 0}};

double GreatestDistance(const RidgePoints& ridge, const std::vector<Polyline>& axes) {
  double greatest = 0;
  for (const Vec3& p : ridge.positions) greatest = std::max(greatest, DistanceTo(axes, p));
  return greatest;
}

// At its very end a ridge turns sideways, by up to a kernel's width.
double GreatestDistanceInside(const RidgePoints& ridge, const std::vector<Polyline>& axes,
                              double from, double to) {
  RidgePoints inside;
  for (const Vec3& p : ridge.positions) {
    if (p.x() > from && p.x() < to) inside.positions.push_back(p);
  }
  return GreatestDistance(inside, axes);
}

double LargestGapAlongX(const RidgePoints& ridge, double from, double to) {
  std::vector<double> x{from, to};
  for (const Vec3& p : ridge.positions) {
    if (p.x() > from && p.x() < to) x.push_back(p.x());
  }
  std::sort(x.begin(), x.end());
  double largest = 0;
  for (size_t i = 1; i < x.size(); ++i) largest = std::max(largest, x[i] - x[i - 1]);
  return largest;
}

TEST(ProjectToRidges, StraightWireGivesItsAxis) {
  const RidgePoints ridge = ProjectToRidges(NoisyWires({kWire}), {});
  // The mean of about 200 points that scatter by 2 mm: .15 mm, four times over.
  EXPECT_LT(GreatestDistanceInside(ridge, {kWire}, 0.004, 0.096), 0.6e-3);
  EXPECT_LT(GreatestDistance(ridge, {kWire}), 3.5e-3);
  // No two points are nearer than 1.5 mm: gaps up to twice that, and one seed missing in between.
  EXPECT_LT(LargestGapAlongX(ridge, 0.003, 0.097), 4.5e-3);
  for (size_t i = 0; i < ridge.size(); ++i) {
    if (ridge.positions[i].x() < 0.01 || ridge.positions[i].x() > 0.09) continue;
    EXPECT_GT(std::abs(ridge.directions[i].x()), std::cos(0.3));  // noise tilts by up to 15 deg
  }
}

TEST(ProjectToRidges, PointsKeepTheirSpacing) {
  const RidgeProjectionOptions options;
  const RidgePoints ridge = ProjectToRidges(NoisyWires({kWire}), options);
  for (size_t i = 0; i < ridge.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      EXPECT_GT((ridge.positions[i] - ridge.positions[j]).norm(), options.spacing);
    }
  }
}

TEST(ProjectToRidges, ThickWireIsOneRidge) {
  const RidgePoints ridge = ProjectToRidges(NoisyWires({kWire}, 6e-3), {});
  ASSERT_GT(ridge.size(), 20U);
  // A kernel for thin wires leaves curves on the surface, 6 mm away. At the ends, the surface
  // ends in a rim that the ridge may follow a little; a kernel stretched to twice its 6 to 8 mm
  // sees it from some 15 mm away.
  for (const Vec3& p : ridge.positions) {
    const bool at_end = p.x() < 0.015 || p.x() > 0.085;
    EXPECT_TRUE(at_end || std::hypot(p.y(), p.z()) < 2e-3) << p.transpose();
  }
}

TEST(ProjectToRidges, NothingLiesBetweenParallelWires) {
  std::vector<Polyline> wires;
  for (int i = 0; i < 4; ++i) wires.push_back({{0, 0.015 * i, 0}, {0.1, 0.015 * i, 0}});
  const RidgePoints ridge = ProjectToRidges(NoisyWires(wires), {});
  ASSERT_GT(ridge.size(), 100U);
  // The neighbour's tail pulls by less than its own noise: as for one wire, and a little.
  EXPECT_LT(GreatestDistanceInside(ridge, wires, 0.004, 0.096), 1e-3);
}

TEST(ProjectToRidges, OutliersAreDropped) {
  ObservedPoints points = NoisyWires({kWire});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(-0.1, 0.2);
  for (int i = 0; i < 300; ++i) {
    points.Add({anywhere(random), anywhere(random), anywhere(random)}, Vec3::Zero(), 1);
  }
  EXPECT_LT(GreatestDistance(ProjectToRidges(points, {}), {kWire}), 3e-3);
}

TEST(ProjectToRidges, SeldomSeenWireHoldsItsOwn) {
  ObservedPoints points = NoisyWires({kWire});
  const Polyline crossing{{0.05, -0.05, 0}, {0.05, 0.05, 0}};
  const size_t first_crossing = points.size();
  const ObservedPoints more = NoisyWires({crossing});
  for (size_t i = 0; i < more.size(); ++i) {
    points.Add(more.positions[i], more.viewing_rays[i], more.counts[i]);
  }
  for (size_t i = 0; i < first_crossing; ++i) points.counts[i] *= 30;
  const RidgePoints ridge = ProjectToRidges(points, {});
  for (double y = -0.045; y < 0.045; y += 0.005) {
    const Vec3 p(0.05, y, 0);
    const bool covered = std::any_of(ridge.positions.begin(), ridge.positions.end(),
                                     [&p](const Vec3& q) { return (p - q).norm() < 4e-3; });
    EXPECT_TRUE(covered || std::abs(y) < 0.012) << "at y = " << y;
  }
}

TEST(ProjectToRidges, DegenerateInput) {
  EXPECT_EQ(ProjectToRidges({}, {}).size(), 0U);
  ObservedPoints one;
  one.Add({1, 2, 3}, Vec3::Zero(), 1);
  EXPECT_LE(ProjectToRidges(one, {}).size(), 1U);
  ObservedPoints coincident;
  for (int i = 0; i < 100; ++i) coincident.Add({1, 2, 3}, Vec3::Zero(), 1);
  EXPECT_LE(ProjectToRidges(coincident, {}).size(), 1U);
}

TEST(ProjectToRidges, PointsThatAreNotFiniteChangeNothing) {
  const ObservedPoints clean = NoisyWires({kWire});
  ObservedPoints points = clean;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  points.Add({nan, 0, 0}, Vec3::Zero(), 1);
  points.Add({0.05, std::numeric_limits<double>::infinity(), 0}, Vec3::Zero(), 1);
  points.Add({0.05, 0, 0}, Vec3::Zero(), std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(ProjectToRidges(points, {}).positions, ProjectToRidges(clean, {}).positions);
}

TEST(ProjectToRidges, SameBitsForAnyNumberOfThreads) {
  const ObservedPoints points = NoisyWires({TestHelix()});
  const auto positions = [&points](int threads) {
    const ThreadLimit limit(threads);
    return ProjectToRidges(points, {}).positions;
  };
  EXPECT_EQ(positions(1), positions(2));
}

TEST(ShiftAlongRays, MovesByItsDistanceAwayFromTheCamera) {
  ObservedPoints points;
  points.Add({1, 0, 0}, {0, 0, 1}, 3);
  points.Add({2, 0, 0}, {0, 1, 0}, 4);
  points.Add({3, 0, 0}, Vec3::Zero(), 5);
  const ObservedPoints shifted = ShiftAlongRays(points, 0.5);
  EXPECT_EQ(shifted.positions, (std::vector<Vec3>{{1, 0, 0.5}, {2, 0.5, 0}, {3, 0, 0}}));
  EXPECT_EQ(shifted.counts, points.counts);
  EXPECT_EQ(shifted.viewing_rays, points.viewing_rays);
  EXPECT_EQ(ShiftAlongRays(points, {0, 2, 4}).positions,
            (std::vector<Vec3>{{1, 0, 0}, {2, 2, 0}, {3, 0, 0}}));
}

TEST(ShiftAlongRays, CentresWiresSeenFromOneSide) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> across(-1, 1);
  std::uniform_real_distribution<double> along(0, 0.1);
  const double radius = 2.5e-3;
  ObservedPoints points;  // seen along +z, uniformly over the silhouette
  for (int i = 0; i < 4000; ++i) {
    const double u = across(random);
    points.Add({along(random), radius * u, -radius * std::sqrt(1 - u * u)}, {0, 0, 1}, 1);
  }
  const RidgePoints ridge = ProjectToRidges(ShiftAlongRays(points, M_PI / 4 * radius), {});
  ASSERT_GT(ridge.size(), 20U);
  double mean = 0;
  for (const Vec3& p : ridge.positions) mean += p.z() / static_cast<double>(ridge.size());
  EXPECT_NEAR(mean, 0, 0.15e-3);  // 4000 points scatter by .6 mm; the kernel's shape adds .1
}

TEST(FollowRidges, FindsTheRidgesOfMovedPointsAgain) {
  const ObservedPoints points = NoisyWires({kWire});
  const RidgePoints before = ProjectToRidges(points, {});
  RigidTransform motion = RigidTransform::Identity();
  motion.translation() = Vec3(0, 0.002, 0.001);
  const RidgePoints after = FollowRidges(Transformed(points, motion), before, {});
  const std::vector<Polyline> moved{{motion * kWire[0], motion * kWire[1]}};
  // As near as ridges found from all points.
  EXPECT_LT(GreatestDistanceInside(after, moved, 0.005, 0.095),
            GreatestDistanceInside(before, {kWire}, 0.005, 0.095) + 2e-4);
  EXPECT_LT(LargestGapAlongX(after, 0.005, 0.095), 0.004);
}

TEST(FollowRidges, TakesWhatSeveralCloudsShowTogether) {
  const Polyline other{{0, 0.03, 0}, {0.1, 0.03, 0}};
  const RidgePoints one = ProjectToRidges(NoisyWires({kWire}), {});
  const RidgePoints before =
      Merged(one, ProjectToRidges(NoisyWires({other}), {}), RidgeProjectionOptions().spacing);
  const ObservedPoints both = NoisyWires({kWire, other});
  const RidgePoints after = FollowRidges(both, before, {});
  EXPECT_GT(after.size(), 1.8 * static_cast<double>(one.size()));
  EXPECT_LT(GreatestDistanceInside(after, {kWire, other}, 0.005, 0.095), 1e-3);
}

// Two bundles that saw the same wire, one moved by less than the spacing.
TEST(MergedRidges, WhereTwoRunTogetherTheStrongerStays) {
  const RidgePoints one = ProjectToRidges(NoisyWires({kWire}), {});
  RidgePoints weaker = Transformed(one, RigidTransform(Eigen::Translation3d(0, 0.0005, 0)));
  for (double& strength : weaker.strengths) strength /= 2;
  const RidgePoints merged = Merged(weaker, one, 0.0015);
  EXPECT_EQ(merged.size(), one.size());
  EXPECT_EQ(std::count_if(merged.strengths.begin(), merged.strengths.end(),
                          [&](double s) {
                            return std::find(one.strengths.begin(), one.strengths.end(), s) !=
                                   one.strengths.end();
                          }),
            static_cast<int64_t>(one.size()));
  EXPECT_EQ(Merged(one, {}, 0.0015).size(), one.size());
}

TEST(FollowRidges, NothingIsFoundWhereNothingWas) {
  EXPECT_EQ(FollowRidges(NoisyWires({kWire}), {}, {}).size(), 0u);
  const RidgePoints before = ProjectToRidges(NoisyWires({kWire}), {});
  EXPECT_EQ(FollowRidges({}, before, {}).size(), 0u);
}

}  // namespace
}  // namespace curvefusion
