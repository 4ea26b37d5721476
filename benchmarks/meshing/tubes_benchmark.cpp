#include <benchmark/benchmark.h>

#include "kernel/parallel.h"
#include "meshing/tubes.h"
#include "tests/meshing/tube_graphs.h"

namespace curvefusion {
namespace {

void Measure(benchmark::State& state, const SkeletonGraph& graph, int threads) {
  const ThreadLimit limit(threads);
  TubeMesh tubes;
  for (auto _ : state) tubes = BuildTubes(graph, {});
  state.counters["unions"] = tubes.unions;
  state.counters["faces"] = static_cast<double>(tubes.report.faces);
  state.counters["s_per_union"] = benchmark::Counter(
      static_cast<double>(tubes.unions) * static_cast<double>(state.iterations()),
      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

// A cubic lattice of n^3 junctions, 5 mm wires 30 mm apart. Arguments: n, threads (0 = all cores).
void BM_TubesOfLattice(benchmark::State& state) {
  Measure(state, LatticeGraph(static_cast<int>(state.range(0)), 0.03, 0.0025),
          static_cast<int>(state.range(1)));
}
BENCHMARK(BM_TubesOfLattice)
    ->Args({4, 1})
    ->Args({4, 0})
    ->Args({8, 0})
    ->Args({14, 0})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void BM_TubesOfCage(benchmark::State& state) { Measure(state, CageGraph(), 0); }
BENCHMARK(BM_TubesOfCage)->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);

void BM_TubesOfChair(benchmark::State& state) { Measure(state, ChairGraph(), 0); }
BENCHMARK(BM_TubesOfChair)->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace curvefusion
