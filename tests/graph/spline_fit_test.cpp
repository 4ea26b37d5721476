#include "graph/spline_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kernel/polyline.h"

namespace curvefusion {
namespace {

constexpr double kTolerance = 0.5 * kMillimetre;

SkeletonEdge EdgeOf(const Polyline& points) { return {{0, 1}, points, {}, {}}; }

// A turn and a half of radius 40 mm that rises 60 mm a turn, at 1 mm steps.
Polyline Helix() {
  Polyline points;
  for (int i = 0; i <= 380; ++i) {
    const double angle = 3 * M_PI * i / 380;
    points.emplace_back(0.04 * std::cos(angle), 0.04 * std::sin(angle), 0.06 * angle / (2 * M_PI));
  }
  return points;
}

// The largest distance from densely sampled places of one curve to the other, both ways.
double Distance(const SkeletonEdge& edge, const CubicSpline& spline) {
  Polyline samples;
  for (int i = 0; i <= 5000; ++i) {
    samples.push_back(spline.At(spline.knots.back() * i / 5000));
  }
  double distance = 0;
  for (const Vec3& p : samples) distance = std::max(distance, Project(edge.points, p).distance);
  for (const Vec3& p : edge.points) distance = std::max(distance, Project(samples, p).distance);
  return distance;
}

void ExpectSound(const SkeletonEdge& edge, const CubicSpline& spline, double tolerance) {
  EXPECT_EQ(spline.points.front(), edge.points.front());
  EXPECT_EQ(spline.points.back(), edge.points.back());
  EXPECT_EQ(spline.knots.size(), spline.points.size() + 4);
  EXPECT_TRUE(std::is_sorted(spline.knots.begin(), spline.knots.end()));
  EXPECT_LE(spline.deviation, tolerance);
  EXPECT_LE(Distance(edge, spline), tolerance * (1 + 1e-6));  // sampled where it was measured
}

TEST(SplineFit, AHelixNeedsFewControlPoints) {
  const SkeletonEdge edge = EdgeOf(Helix());
  const CubicSpline spline = FitSpline(edge, kTolerance);
  ExpectSound(edge, spline, kTolerance);
  // Eight pieces of 68 degrees; a cubic leaves an arc of 135 degrees and 40 mm by more than .1 mm.
  // mm.
  EXPECT_LE(spline.points.size(), 11u);
  const CubicSpline finer = FitSpline(edge, kTolerance / 100);
  ExpectSound(edge, finer, kTolerance / 100);
  EXPECT_GT(finer.points.size(), spline.points.size());
}

TEST(SplineFit, AStraightEdgeIsOnePiece) {
  const SkeletonEdge edge = EdgeOf({Vec3(0.1, 0, 0), Vec3(0.1, 0.2, 0), Vec3(0.1, 1, 0)});
  const CubicSpline spline = FitSpline(edge, kTolerance);
  ExpectSound(edge, spline, kTolerance);
  EXPECT_EQ(spline.points.size(), 4u);
}

TEST(SplineFit, CornersAndNoiseStayWithinTheTolerance) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-1, 1);
  for (int trial = 0; trial < 30; ++trial) {
    Polyline points = {Vec3::Zero()};
    for (int i = 0; i < 40; ++i) {
      points.push_back(points.back() +
                       0.01 * Vec3(1 + noise(random), noise(random), noise(random)));
    }
    const SkeletonEdge edge = EdgeOf(points);
    ExpectSound(edge, FitSpline(edge, kTolerance), kTolerance);
  }
}

// Shorter than the tolerance, of a tolerance that no samples reach, and closed.
TEST(SplineFit, EdgesThatAreHardToFit) {
  const SkeletonEdge shorter = EdgeOf({Vec3(0, 0, 0), Vec3(1e-4, 0, 0), Vec3(1e-4, 1e-4, 0)});
  const CubicSpline pieces = FitSpline(shorter, kTolerance);
  EXPECT_EQ(pieces.points.back(), shorter.points.back());
  EXPECT_EQ(pieces.knots.size(), pieces.points.size() + 4);
  const SkeletonEdge corner = EdgeOf({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0)});
  ExpectSound(corner, FitSpline(corner, 1e-9), 1e-9);
  Polyline ring;
  for (int i = 0; i <= 100; ++i) {
    ring.emplace_back(0.05 * std::cos(M_PI * i / 50), 0.05 * std::sin(M_PI * i / 50), 0);
  }
  ring.back() = ring.front();
  ExpectSound(EdgeOf(ring), FitSpline(EdgeOf(ring), kTolerance), kTolerance);
}

TEST(SplineFit, BezierPiecesAreTheSameCurve) {
  SkeletonEdge edge = EdgeOf(Helix());
  for (size_t i = 0; i < edge.points.size(); ++i)
    edge.radii.push_back(0.002 + 1e-6 * static_cast<double>(i));
  const CubicSpline spline = FitSpline(edge, kTolerance / 10);
  const auto bezier = BezierPoints(spline);
  ASSERT_EQ(bezier.size() % 3, 1u);
  std::vector<double> spans;
  for (const double knot : spline.knots) {
    if (spans.empty() || knot > spans.back()) spans.push_back(knot);
  }
  ASSERT_EQ(bezier.size(), 3 * (spans.size() - 1) + 1);
  for (size_t i = 0; i + 1 < spans.size(); ++i) {
    for (const double t : {0.0, 0.3, 0.5, 0.9}) {
      const double u = 1 - t;
      const Eigen::Vector4d at = u * u * u * bezier[3 * i] + 3 * u * u * t * bezier[3 * i + 1] +
                                 3 * u * t * t * bezier[3 * i + 2] + t * t * t * bezier[3 * i + 3];
      const Vec3 expected = spline.At(u * spans[i] + t * spans[i + 1]);
      EXPECT_LT((at.head<3>() - expected).norm(), 1e-12);
      EXPECT_GE(at[3], 0.002 - 1e-9);
      EXPECT_LE(at[3], 0.00238 + 1e-9);
    }
  }
}

}  // namespace
}  // namespace curvefusion
