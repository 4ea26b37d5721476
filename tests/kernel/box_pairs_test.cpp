#include "kernel/box_pairs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "kernel/geometry.h"
#include "kernel/parallel.h"

namespace curvefusion {
namespace {

using Boxes = std::vector<Eigen::AlignedBox3d>;
using Pairs = std::vector<std::pair<int, int>>;

// Boxes of very different sizes, flat and point-like ones and equal ones too.
Boxes RandomBoxes(int count, std::mt19937& random) {
  std::uniform_real_distribution<double> place(-1, 1);
  std::uniform_real_distribution<double> exponent(-3, 0);
  Boxes boxes;
  for (int i = 0; i < count; ++i) {
    const Vec3 low(place(random), place(random), place(random));
    const double size = std::pow(10, exponent(random));
    boxes.emplace_back(low, Vec3(low + size * Vec3(1, i % 3 == 0 ? 0 : 1, i % 5 == 0 ? 0 : 1)));
    if (i % 7 == 0) boxes.push_back(boxes.back());
  }
  return boxes;
}

// Takes away the pairs for which keep(i, j) does not hold.
template <class Keep>
BoxTree::Filter Keeping(const Keep& keep) {
  return [keep](Pairs& pairs) {
    std::erase_if(pairs, [&keep](const auto& pair) { return !keep(pair.first, pair.second); });
  };
}

Pairs AllPairs(const Boxes& boxes, const BoxTree::Filter& filter = nullptr) {
  Pairs pairs;
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(boxes.size()); ++j)
      if (boxes[i].intersects(boxes[j])) pairs.emplace_back(i, j);
  if (filter) filter(pairs);
  return pairs;
}

TEST(OverlappingBoxes, EqualBruteForce) {
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    const Boxes boxes = RandomBoxes(20 * round, random);
    EXPECT_EQ(OverlappingBoxes(boxes), AllPairs(boxes));
  }
}

// Of numbers far above the boxes of one parallel task too.
TEST(BoxTree, PairsThatAreKeptEqualBruteForce) {
  std::mt19937 random(8);
  const auto keep = Keeping([](int i, int j) { return i < j && (i + j) % 3 == 0; });
  for (const int count : {0, 1, 7, 300, 4000}) {
    const Boxes boxes = RandomBoxes(count, random);
    EXPECT_EQ(BoxTree(boxes).OverlappingPairs(keep), AllPairs(boxes, keep)) << count;
  }
}

TEST(BoxTree, PairsWithOtherBoxesEqualBruteForce) {
  std::mt19937 random(10);
  for (const auto& [count, other_count] : {std::pair(0, 5), {5, 0}, {1, 1}, {300, 100}}) {
    const Boxes boxes = RandomBoxes(count, random);
    const Boxes others = RandomBoxes(other_count, random);
    Pairs expected;
    Pairs expected_kept;
    for (int i = 0; i < static_cast<int>(boxes.size()); ++i) {
      for (int j = 0; j < static_cast<int>(others.size()); ++j) {
        if (!boxes[i].intersects(others[j])) continue;
        expected.emplace_back(i, j);
        if (i > j) expected_kept.emplace_back(i, j);
      }
    }
    EXPECT_EQ(BoxTree(boxes).OverlappingPairs(others), expected);
    EXPECT_EQ(BoxTree(boxes).OverlappingPairs(others, Keeping([](int i, int j) { return i > j; })),
              expected_kept);
  }
}

TEST(OverlappingBoxes, DoNotDependOnTheNumberOfThreads) {
  std::mt19937 random(9);
  const Boxes boxes = RandomBoxes(20000, random);
  const auto keep = Keeping([](int i, int) { return i % 50 == 0; });
  Pairs serial;
  {
    const ThreadLimit one(1);
    serial = BoxTree(boxes).OverlappingPairs(keep);
  }
  EXPECT_EQ(BoxTree(boxes).OverlappingPairs(keep), serial);
}

TEST(OverlappingBoxes, CanBeNoneOneOrWithoutEnd) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Eigen::AlignedBox3d all(Vec3::Constant(-kInfinity), Vec3::Constant(kInfinity));
  const Eigen::AlignedBox3d point(Vec3::Zero(), Vec3::Zero());
  EXPECT_EQ(OverlappingBoxes({}), Pairs());
  EXPECT_EQ(OverlappingBoxes({point}), Pairs());
  EXPECT_EQ(OverlappingBoxes({all, point, all}), Pairs({{0, 1}, {0, 2}, {1, 2}}));
}

}  // namespace
}  // namespace curvefusion
