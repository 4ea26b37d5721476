// Registration of bundles and frames to the ridges of a lattice of wires.
#include <benchmark/benchmark.h>

#include <chrono>

#include "graph/contraction/ridge_projection.h"
#include "kernel/parallel.h"
#include "tests/graph/noisy_wires.h"

namespace curvefusion {
namespace {

// A square lattice of wires 50 mm apart.
ObservedPoints Lattice(int wires) {
  std::vector<Polyline> axes;
  const double side = 0.05 * (wires - 1);
  for (int i = 0; i < wires; ++i) {
    axes.push_back({{0.05 * i, 0, 0}, {0.05 * i, side, 0}});
    axes.push_back({{0, 0.05 * i, 0}, {side, 0.05 * i, 0}});
  }
  return NoisyWires(axes);
}

// Points that have moved a little, as between two rounds. Argument: wires each way. `of anew` is
// the share of the time of finding their ridges anew, measured in the same run.
void BM_FollowRidges(benchmark::State& state) {
  const ThreadLimit limit(1);
  const ObservedPoints points = Lattice(static_cast<int>(state.range(0)));
  RigidTransform motion = RigidTransform::Identity();
  motion.translation() = Vec3(0.001, 0.001, 0.0005);
  const ObservedPoints moved = Transformed(points, motion);
  const auto start = std::chrono::steady_clock::now();
  const RidgePoints before = ProjectToRidges(points, {});
  const std::chrono::duration<double> anew = std::chrono::steady_clock::now() - start;
  size_t followed = 0;
  for (auto _ : state) followed = FollowRidges(moved, before, {}).size();
  state.counters["points"] = static_cast<double>(points.size());
  state.counters["found anew"] = static_cast<double>(before.size());
  state.counters["followed"] = static_cast<double>(followed);
  state.counters["of anew"] = benchmark::Counter(
      anew.count(), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(BM_FollowRidges)->Arg(9)->Arg(15)->ArgName("wires")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace curvefusion
