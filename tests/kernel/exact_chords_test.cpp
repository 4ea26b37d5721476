#include "kernel/exact_chords.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace curvefusion {
namespace {

const Segment kAlongX{{0, 0, 0}, {100, 0, 0}};

TEST(ExactChords, OrderIsDecidedAtTheLimit) {
  // Triangles with sides of 3, 4 and 5: the chords of radius 5 reach 4 and 3 to either side.
  const Vec3 p(50, 3, 0);
  const double last = 50 - 4 - 3;
  EXPECT_TRUE(AreInOrder(kAlongX, p, {last, 0, 4}, 5));
  EXPECT_FALSE(AreInOrder(kAlongX, p, {std::nextafter(last, 0.0), 0, 4}, 5));
  EXPECT_TRUE(AreInOrder(kAlongX, p, {60, 0, 4}, 5));
}

TEST(ExactChords, BeginningsAreComparedExactly) {
  const Vec3 p(50, 3, 0);  // its chord begins at 46
  EXPECT_FALSE(BeginsLater(kAlongX, p, {49, 0, 4}, 5));
  EXPECT_TRUE(BeginsLater(kAlongX, p, {std::nextafter(49.0, 0.0), 0, 4}, 5));
  EXPECT_FALSE(BeginsLater(kAlongX, {49, 0, 4}, p, 5));
  EXPECT_TRUE(BeginsLater(kAlongX, {std::nextafter(49.0, 50.0), 0, 4}, p, 5));
}

TEST(ExactChords, PointsAtDistanceZeroAreInTheirOrder) {
  EXPECT_TRUE(AreInOrder(kAlongX, {3, 0, 0}, {3, 0, 0}, 0));
  EXPECT_FALSE(AreInOrder(kAlongX, {std::nextafter(3.0, 4.0), 0, 0}, {3, 0, 0}, 0));
  EXPECT_TRUE(BeginsLater(kAlongX, {std::nextafter(3.0, 4.0), 0, 0}, {3, 0, 0}, 0));
}

// Along an axis, with whole numbers: the sums and differences of roots of whole numbers, where long
// double is sure.
TEST(ExactChords, AgreesWithLongDouble) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> digit(-30, 30);
  int decided = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p(50 + digit(random), digit(random), digit(random));
    const Vec3 q(50 + digit(random), digit(random), digit(random));
    const double distance = 45;
    const auto half = [distance](const Vec3& v) {
      return std::sqrt(
          static_cast<long double>(distance * distance - v.y() * v.y() - v.z() * v.z()));
    };
    const long double order = half(p) + half(q) - (p.x() - q.x());
    const long double later = (p.x() - q.x()) - half(p) + half(q);
    if (std::abs(order) > 1e-12) {
      EXPECT_EQ(AreInOrder(kAlongX, p, q, distance), order > 0);
    }
    if (std::abs(later) > 1e-12) {
      ++decided;
      EXPECT_EQ(BeginsLater(kAlongX, p, q, distance), later > 0);
    }
  }
  EXPECT_GT(decided, 10000);
}

// The filter must say what exact numbers do: the same geometry turned, moved and so tiny in
// difference that only these can tell.
TEST(ExactChords, OneUlpDecidesInAnyDirection) {
  const Vec3 u(0.25, -0.5, 0.125);
  const Segment s{{1, 2, 3}, Vec3(1, 2, 3) + 8 * u};
  const Vec3 p = s.a + 4 * u;  // on the segment, exactly
  const Vec3 q = s.a + 2 * u;
  const double half = u.norm();  // sqrt(21) / 8, rounded
  EXPECT_NE(AreInOrder(s, p, q, std::nextafter(half, 0.0)),
            AreInOrder(s, p, q, std::nextafter(half, 1.0)));
}

TEST(ExactChords, BeginsWhereTheSphereIsEntered) {
  EXPECT_NEAR(ChordBegin(kAlongX, {50, 3, 0}, 5), 0.46, 1e-12);
  EXPECT_EQ(ChordBegin(kAlongX, {1, 0, 0}, 5), 0);
}

}  // namespace
}  // namespace curvefusion
