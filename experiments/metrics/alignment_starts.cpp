#include "experiments/metrics/alignment_starts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "experiments/metrics/alignment_points.h"
#include "kernel/angle.h"

namespace curvefusion {
namespace {

constexpr double kStep = 10 * kMillimetre;  // half of the first gate of the alignment

std::vector<RigidTransform> Shifts() {
  constexpr int kSteps = static_cast<int>(kSearchReach / kStep + 0.5);
  std::vector<RigidTransform> shifts;
  for (int x = -kSteps; x <= kSteps; ++x) {
    for (int y = -kSteps; y <= kSteps; ++y) {
      for (int z = -kSteps; z <= kSteps; ++z) {
        RigidTransform shift = RigidTransform::Identity();
        shift.translation() = kStep * Vec3(x, y, z);
        shifts.push_back(shift);
      }
    }
  }
  return shifts;
}

// A start as it is, and turned about the axes by what moves the truth by 1.5 steps.
std::vector<RigidTransform> Turns(const RigidTransform& start, const PointSpread& truth) {
  constexpr double kMost = 10 * kDegree;  // of small objects
  const double angle = std::min(kMost, 1.5 * kStep / truth.radius);
  std::vector<RigidTransform> turns = {start};
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1, 1}) {
      turns.push_back(TurnAbout(truth.center, sign * angle * Vec3::Unit(axis)) * start);
    }
  }
  return turns;
}

// The starts by how much of the truth they explain; equal ones in their order.
std::vector<RigidTransform> Ranked(const std::vector<RigidTransform>& starts,
                                   const ExplainingPoints& result, const std::vector<Vec3>& truth) {
  std::vector<double> shares;
  for (const RigidTransform& start : starts) {
    shares.push_back(result.ShareOf(truth, start, 2 * kStep));
  }
  std::vector<size_t> order(starts.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return shares[a] > shares[b]; });
  std::vector<RigidTransform> ranked;
  for (const size_t i : order) ranked.push_back(starts[i]);
  return ranked;
}

// The first few that are no neighbours of each other.
std::vector<RigidTransform> Distinct(const std::vector<RigidTransform>& ranked) {
  constexpr size_t kKept = 4;
  std::vector<RigidTransform> kept;
  for (const RigidTransform& start : ranked) {
    const bool is_new = std::all_of(kept.begin(), kept.end(), [&](const RigidTransform& other) {
      return (start.translation() - other.translation()).norm() > 1.5 * kStep;
    });
    if (is_new) kept.push_back(start);
    if (kept.size() == kKept) break;
  }
  return kept;
}

}  // namespace

std::vector<RigidTransform> AlignmentStarts(const ExplainingPoints& result,
                                            const std::vector<Vec3>& truth) {
  constexpr size_t kLooks = 300;  // points; they tell a share to some 3 %
  const std::vector<Vec3> some = Thinned(truth, kLooks);
  const PointSpread spread = SpreadOfPoints(truth);
  std::vector<RigidTransform> starts = Distinct(Ranked(Shifts(), result, some));
  for (RigidTransform& start : starts) {
    start = Ranked(Turns(start, spread), result, some).front();
  }
  return starts;
}

}  // namespace curvefusion
