#include "experiments/metrics/point_matching.h"

#include <utility>

#include "experiments/metrics/assignment.h"
#include "kernel/point_grid.h"

namespace curvefusion {
namespace {

// Which points of the other set each point may pair with.
struct Neighbours {
  std::vector<std::vector<int>> of_expected;
  std::vector<std::vector<int>> of_found;
};

Neighbours FindNeighbours(const std::vector<Vec3>& expected, const std::vector<Vec3>& found,
                          double max_distance) {
  Neighbours near{std::vector<std::vector<int>>(expected.size()),
                  std::vector<std::vector<int>>(found.size())};
  const PointGrid grid(found, max_distance);
  for (size_t i = 0; i < expected.size(); ++i) {
    grid.ForEachWithin(expected[i], max_distance, [&](int j, const Vec3& p) {
      if ((expected[i] - p).norm() >= max_distance) return;
      near.of_expected[i].push_back(j);
      near.of_found[j].push_back(static_cast<int>(i));
    });
  }
  return near;
}

// Points that are chained by possible pairs: what is paired in one group does not touch others.
struct Group {
  std::vector<int> expected;
  std::vector<int> found;
};

Group GroupOf(int first, const Neighbours& near, std::vector<char>& has_expected,
              std::vector<char>& has_found) {
  Group group;
  has_expected[first] = true;
  group.expected.push_back(first);
  for (size_t next = 0; next < group.expected.size(); ++next) {
    for (const int j : near.of_expected[group.expected[next]]) {
      if (std::exchange(has_found[j], true)) continue;
      group.found.push_back(j);
      for (const int i : near.of_found[j]) {
        if (!std::exchange(has_expected[i], true)) group.expected.push_back(i);
      }
    }
  }
  return group;
}

void PairGroup(const Group& group, const std::vector<Vec3>& expected,
               const std::vector<Vec3>& found, double max_distance, std::vector<int>& partner) {
  constexpr double kTooFar = 1e3;  // one more pair is worth more than any sum of distances
  Eigen::MatrixXd cost(group.expected.size(), group.found.size());
  for (size_t i = 0; i < group.expected.size(); ++i) {
    for (size_t j = 0; j < group.found.size(); ++j) {
      const double distance = (expected[group.expected[i]] - found[group.found[j]]).norm();
      cost(i, j) = distance < max_distance ? distance : kTooFar;
    }
  }
  const std::vector<int> column = MinimumCostAssignment(cost);
  for (size_t i = 0; i < group.expected.size(); ++i) {
    if (column[i] < 0 || cost(i, column[i]) >= kTooFar) continue;
    partner[group.expected[i]] = group.found[column[i]];
  }
}

}  // namespace

std::vector<int> MatchPoints(const std::vector<Vec3>& expected, const std::vector<Vec3>& found,
                             double max_distance) {
  std::vector<int> partner(expected.size(), -1);
  const Neighbours near = FindNeighbours(expected, found, max_distance);
  std::vector<char> has_expected(expected.size(), false);
  std::vector<char> has_found(found.size(), false);
  for (size_t i = 0; i < expected.size(); ++i) {
    if (has_expected[i] || near.of_expected[i].empty()) continue;
    const Group group = GroupOf(static_cast<int>(i), near, has_expected, has_found);
    PairGroup(group, expected, found, max_distance, partner);
  }
  return partner;
}

}  // namespace curvefusion
