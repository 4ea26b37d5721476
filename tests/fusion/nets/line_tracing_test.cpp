#include "fusion/nets/line_tracing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace curvefusion {
namespace {

constexpr int kSize = 240;
constexpr double kPixel = 0.0006;
constexpr double kHalfWidth = 0.0012 / kPixel;

// 1 where something is at most half a width off, else -1.
Image<float> Drawn(const std::function<double(const Vec2&)>& distance) {
  Image<float> image(kSize, kSize);
  for (int v = 0; v < kSize; ++v)
    for (int u = 0; u < kSize; ++u) image(u, v) = distance(Vec2(u, v)) < kHalfWidth ? 1.0F : -1.0F;
  return image;
}

const MaskImage kAllKnown(kSize, kSize, 1);

TEST(TraceLines, EachLineGoesStraightOnThroughACrossing) {
  const auto lines = TraceLines(Drawn([](const Vec2& p) {
                                  const double a = std::abs(p.y() - 100 - 0.1 * p.x());
                                  return std::min(a, std::abs(p.x() - 120));
                                }),
                                kAllKnown, kPixel);
  ASSERT_EQ(lines.size(), 2u);
  for (const ImageLine& line : lines) {
    EXPECT_GT(line.size(), 220u);
    for (const Vec2& p : line) {
      const double off = std::min(std::abs(p.y() - 100 - 0.1 * p.x()), std::abs(p.x() - 120));
      EXPECT_LT(off, 1);
    }
  }
}

TEST(TraceLines, ARingIsOneLine) {
  const auto lines =
      TraceLines(Drawn([](const Vec2& p) { return std::abs((p - Vec2(120, 120)).norm() - 70); }),
                 kAllKnown, kPixel);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(static_cast<double>(lines[0].size()), 2 * M_PI * 70, 10);
  EXPECT_LT((lines[0].front() - lines[0].back()).norm(), 3);
}

// A line that leads into a ring must not go around in it for ever.
TEST(TraceLines, ALineIntoARingEnds) {
  const auto lines = TraceLines(Drawn([](const Vec2& p) {
                                  const double ring = std::abs((p - Vec2(120, 120)).norm() - 60);
                                  return p.x() < 120 ? std::min(ring, std::abs(p.y() - 180)) : ring;
                                }),
                                kAllKnown, kPixel);
  size_t length = 0;
  for (const ImageLine& line : lines) length += line.size();
  EXPECT_NEAR(static_cast<double>(length), 2 * M_PI * 60 + 120, 60);
}

TEST(TraceLines, NothingOutsideOfWhatIsKnownNorInNoise) {
  MaskImage left = kAllKnown;
  for (int v = 0; v < kSize; ++v) std::fill(left.row(v) + 150, left.row(v) + kSize, uint8_t{0});
  const auto lines =
      TraceLines(Drawn([](const Vec2& p) { return std::abs(p.y() - 60); }), left, kPixel);
  ASSERT_EQ(lines.size(), 1u);
  for (const Vec2& p : lines[0]) EXPECT_LT(p.x(), 150);
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  Image<float> noise(kSize, kSize);
  for (size_t i = 0; i < noise.size(); ++i) noise.data()[i] = normal(random);
  EXPECT_TRUE(TraceLines(noise, kAllKnown, kPixel).empty());
}

}  // namespace
}  // namespace curvefusion
