#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "graph/contraction/ridge_skeleton.h"
#include "kernel/parallel.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {
namespace {

// A square lattice of 5 mm wires 50 mm apart, seen from above with 1 mm of noise, on a grid of 2.5
// mm with counts: what a whole scan holds after its bundles are aligned.
ObservedPoints LatticeScan(int wires) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 1e-3);
  std::uniform_real_distribution<double> silhouette(-1, 1);
  const double radius = 2.5e-3;
  const double side = 0.05 * (wires - 1);
  std::uniform_real_distribution<double> along(0, side);
  ObservedPoints points;
  for (int k = 0; k < 2 * wires; ++k) {
    for (int i = 0; i < static_cast<int>(side * 60000); ++i) {
      const double u = silhouette(random);
      const double across = 0.05 * (k / 2) + radius * u + noise(random);
      const double z = radius * std::sqrt(1 - u * u) + 2 * noise(random);
      const double s = along(random);
      points.Add(k % 2 == 0 ? Vec3(s, across, z) : Vec3(across, s, z), -Vec3::UnitZ(), 1);
    }
  }
  return ShiftAlongRays(ResampleOnGrid(points, 2.5e-3), 0.78 * radius);
}

// Arguments: wires each way, threads. Aim: 1.5 s for 50,000 points on two threads.
void BM_ExtractRidgeSkeleton(benchmark::State& state) {
  const ObservedPoints points = LatticeScan(static_cast<int>(state.range(0)));
  const ThreadLimit limit(static_cast<int>(state.range(1)));
  SkeletonGraph graph;
  for (auto _ : state) graph = ExtractRidgeSkeleton(points, {});
  state.counters["points"] = static_cast<double>(points.size());
  state.counters["cycles"] = graph.CycleRank();
  state.counters["points/s"] = benchmark::Counter(static_cast<double>(points.size()),
                                                  benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(BM_ExtractRidgeSkeleton)
    ->ArgsProduct({{5, 9, 15}, {1, 2}})
    ->ArgNames({"wires", "threads"})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

// Arguments: wires each way, distance of ridge points in micrometres.
void BM_ProjectToRidges(benchmark::State& state) {
  const ObservedPoints points = LatticeScan(static_cast<int>(state.range(0)));
  const ThreadLimit limit(1);
  RidgeProjectionOptions options;
  options.spacing = 1e-6 * static_cast<double>(state.range(1));
  size_t ridge_points = 0;
  for (auto _ : state) ridge_points = ProjectToRidges(points, options).size();
  state.counters["points"] = static_cast<double>(points.size());
  state.counters["ridge points"] = static_cast<double>(ridge_points);
}
BENCHMARK(BM_ProjectToRidges)
    ->ArgsProduct({{9}, {1500, 3000}})
    ->ArgNames({"wires", "spacing"})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

// From ridge points to the placed junctions, which takes a hundredth of the projection.
void BM_ConnectRidgePoints(benchmark::State& state) {
  const RidgePoints ridge = ProjectToRidges(LatticeScan(static_cast<int>(state.range(0))), {});
  for (auto _ : state) benchmark::DoNotOptimize(ConnectRidgePoints(ridge, {}));
  state.counters["ridge points"] = static_cast<double>(ridge.size());
}
BENCHMARK(BM_ConnectRidgePoints)->Arg(15)->ArgName("wires")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace curvefusion
