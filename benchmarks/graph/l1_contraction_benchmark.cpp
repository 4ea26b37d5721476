#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "graph/contraction/l1_contraction.h"
#include "kernel/parallel.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {
namespace {

// A square lattice of 5 mm wires 50 mm apart, each point 1.5 mm off along z as in a depth image, on
// the paper's grid: what a bundle of 30 frames holds.
ObservedPoints LatticeBundle(int wires) {
  std::mt19937 random(1);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> angle(0, M_PI);  // the side that the camera sees
  const double side = 0.05 * (wires - 1);
  std::uniform_real_distribution<double> along(0, side);
  ObservedPoints points;
  for (int k = 0; k < 2 * wires; ++k) {
    for (int i = 0; i < static_cast<int>(side * 20000); ++i) {
      const double a = angle(random);
      const double across = 0.05 * (k / 2) + 2.5e-3 * std::cos(a);
      const double z = 2.5e-3 * std::sin(a) + 1.5e-3 * gauss(random);
      const double s = along(random);
      points.Add(k % 2 == 0 ? Vec3(s, across, z) : Vec3(across, s, z), Vec3::Zero(), 1);
    }
  }
  return ResampleOnGrid(points, 2.5e-3);
}

// Arguments: wires each way, threads. The paper takes 12 s a bundle on four cores.
void BM_ExtractL1Skeleton(benchmark::State& state) {
  const ObservedPoints points = LatticeBundle(static_cast<int>(state.range(0)));
  const ThreadLimit limit(static_cast<int>(state.range(1)));
  SkeletonGraph graph;
  for (auto _ : state) graph = ExtractL1Skeleton(points, {});
  state.counters["points"] = static_cast<double>(points.size());
  state.counters["cycles"] = graph.CycleRank();
  state.counters["points/s"] = benchmark::Counter(static_cast<double>(points.size()),
                                                  benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(BM_ExtractL1Skeleton)
    ->ArgsProduct({{5, 7, 9}, {1, 2}})
    ->ArgNames({"wires", "threads"})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void BM_TraceBranches(benchmark::State& state) {
  const ContractedSamples samples =
      ContractToMedian(LatticeBundle(static_cast<int>(state.range(0))), {});
  for (auto _ : state) benchmark::DoNotOptimize(TraceBranches(samples, {}));
  state.counters["samples"] = static_cast<double>(samples.size());
}
BENCHMARK(BM_TraceBranches)->Arg(7)->ArgName("wires")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace curvefusion
