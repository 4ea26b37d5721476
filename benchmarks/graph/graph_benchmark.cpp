#include <benchmark/benchmark.h>

#include <boost/graph/connected_components.hpp>
#include <cmath>
#include <random>

#include "graph/boost_graph.h"
#include "graph/connected_parts.h"
#include "graph/graph_smoother.h"
#include "graph/intersections.h"
#include "graph/parallel_edges.h"
#include "graph/segment_pairs.h"
#include "graph/sparse_solver.h"
#include "kernel/parallel.h"

namespace curvefusion {
namespace {

constexpr double kThreshold = 3 * kMillimetre;

// Wires of 1 mm segments that cross every 50 mm, 1 mm apart: about `segments` in all.
SkeletonGraph Wires(int64_t segments) {
  constexpr int kPerCell = 50;
  const int wires = std::max(1, static_cast<int>(std::sqrt(segments / (2.0 * kPerCell))));
  SkeletonGraph graph;
  const double length = wires * 0.05;
  for (int i = 0; i < wires; ++i) {
    const double at = 0.05 * i;
    graph.AddPolyline(Resample({{-0.01, at, 0}, {length, at, 0}}, 0.001));
    graph.AddPolyline(Resample({{at, -0.01, 0.001}, {at, length, 0.001}}, 0.001));
  }
  return graph;
}

// A lattice of wires of 20 mm segments in all three directions, one crossing of three a segment.
SkeletonGraph Lattice(int64_t segments) {
  constexpr double kPitch = 0.02;
  const int cells = std::max(1, static_cast<int>(std::cbrt(static_cast<double>(segments) / 3)));
  const double length = cells * kPitch + 0.01;
  SkeletonGraph graph;
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) {
      const double u = kPitch * i;
      const double v = kPitch * j;
      graph.AddPolyline(Resample({{-0.01, u, v}, {length, u, v}}, kPitch));
      graph.AddPolyline(Resample({{u, -0.01, v + 0.001}, {u, length, v + 0.001}}, kPitch));
      graph.AddPolyline(Resample({{u + 0.001, v, -0.01}, {u + 0.001, v, length}}, kPitch));
    }
  }
  return graph;
}

// Single segments of 20 mm at random, so dense that each meets one other on average: the density
// does not depend on their number.
SkeletonGraph RandomSegments(int64_t segments) {
  std::mt19937_64 random(1);
  const double half = 0.5 * std::cbrt(static_cast<double>(segments) * 2e-6);
  std::uniform_real_distribution<double> place(-half, half);
  std::normal_distribution<double> direction;
  SkeletonGraph graph;
  for (int64_t i = 0; i < segments; ++i) {
    const Vec3 a(place(random), place(random), place(random));
    const Vec3 u(direction(random), direction(random), direction(random));
    graph.AddPolyline({a, a + 0.02 * u.normalized()});
  }
  return graph;
}

size_t SegmentCount(const SkeletonGraph& graph) {
  size_t count = 0;
  for (const EdgeId id : graph.Edges()) count += graph.edge(id).points.size() - 1;
  return count;
}

template <SkeletonGraph (*kMake)(int64_t)>
void Resolve(benchmark::State& state) {
  const ThreadLimit one_core(1);
  const SkeletonGraph graph = kMake(state.range(0));
  int rounds = 0;
  for (auto _ : state) {
    SkeletonGraph resolved = graph;
    rounds = ResolveIntersections(resolved, kThreshold).joining;
    benchmark::DoNotOptimize(resolved);
  }
  state.counters["segments"] = static_cast<double>(SegmentCount(graph));
  state.counters["rounds"] = rounds;
}
BENCHMARK(Resolve<Wires>)->RangeMultiplier(10)->Range(1000, 1000000)->Unit(benchmark::kMillisecond);
BENCHMARK(Resolve<Lattice>)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(Resolve<RandomSegments>)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMillisecond);

template <SkeletonGraph (*kMake)(int64_t)>
void FindPairs(benchmark::State& state) {
  const ThreadLimit one_core(1);
  const SegmentTable table(kMake(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(SegmentPairsInContact(table, kThreshold));
}
BENCHMARK(FindPairs<Wires>)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(FindPairs<Lattice>)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(FindPairs<RandomSegments>)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMillisecond);

// The reference: every pair, with the same exact decision.
template <SkeletonGraph (*kMake)(int64_t)>
void FindPairsAmongAll(benchmark::State& state) {
  const SegmentTable table(kMake(state.range(0)));
  for (auto _ : state) {
    int64_t found = 0;
    for (int s = 0; s < table.point_count(); ++s)
      for (int t = s + 1; t < table.point_count(); ++t)
        if (table.IsSegment(s) && table.IsSegment(t))
          found += AreInContact(table, {s, t}, kThreshold);
    benchmark::DoNotOptimize(found);
  }
}
BENCHMARK(FindPairsAmongAll<Wires>)->Arg(1000)->Arg(3000)->Unit(benchmark::kMillisecond);
BENCHMARK(FindPairsAmongAll<Lattice>)->Arg(1000)->Arg(3000)->Unit(benchmark::kMillisecond);
BENCHMARK(FindPairsAmongAll<RandomSegments>)->Arg(1000)->Arg(3000)->Unit(benchmark::kMillisecond);

// Two wavy curves of n points from node to node, 1 mm apart.
SkeletonGraph TwinCurves(int64_t points) {
  SkeletonGraph graph;
  const NodeId first = graph.AddNode(Vec3::Zero());
  const NodeId last = graph.AddNode({0.001 * static_cast<double>(points), 0, 0});
  for (const double height : {0.0, 0.001}) {
    Polyline curve = {graph.position(first)};
    for (int64_t i = 1; i < points; ++i) {
      const double x = 0.001 * static_cast<double>(i);
      curve.emplace_back(x, 0.01 * std::sin(20 * x), height);
    }
    curve.push_back(graph.position(last));
    graph.AddEdge({{first, last}, curve, {}, {}});
  }
  return graph;
}

void MergeParallel(benchmark::State& state) {
  const SkeletonGraph graph = TwinCurves(state.range(0));
  for (auto _ : state) {
    SkeletonGraph merged = graph;
    MergeParallelEdges(merged, kThreshold);
    benchmark::DoNotOptimize(merged);
  }
}
BENCHMARK(MergeParallel)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);

// The reference: each point against the whole other curve.
void FindParallelByProjection(benchmark::State& state) {
  const SkeletonGraph graph = TwinCurves(state.range(0));
  for (auto _ : state) {
    bool is_parallel = true;
    for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 0)})
      for (const Vec3& p : graph.edge(a).points)
        is_parallel = is_parallel && Project(graph.edge(b).points, p).distance <= kThreshold;
    benchmark::DoNotOptimize(is_parallel);
  }
}
BENCHMARK(FindParallelByProjection)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

template <SkeletonGraph (*kMake)(int64_t)>
SkeletonGraph Resolved(int64_t segments) {
  SkeletonGraph graph = kMake(segments);
  ResolveIntersections(graph, kThreshold);
  return graph;
}

void Smooth(benchmark::State& state) {
  const SkeletonGraph graph = Resolved<Wires>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(SmoothGraph(graph, {}));
}
void SmoothAgain(benchmark::State& state) {
  const SkeletonGraph graph = Resolved<Wires>(state.range(0));
  GraphSmoother smoother;
  smoother.Smooth(graph, {});
  for (auto _ : state) benchmark::DoNotOptimize(smoother.Smooth(graph, {}));
}
BENCHMARK(SmoothAgain)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(Smooth)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);

// The lower triangle of the system that smooths one curve of so many points.
Eigen::SparseMatrix<double> CurveSystem(int points) {
  constexpr double kLambda = 60;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < points; ++i) entries.emplace_back(i, i, 1);
  for (int i = 1; i + 1 < points; ++i) {
    const double bend[] = {1, -2, 1};
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b <= a; ++b)
        entries.emplace_back(i - 1 + a, i - 1 + b, kLambda * bend[a] * bend[b]);
  }
  Eigen::SparseMatrix<double> lower(points, points);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

void SolveSparse(benchmark::State& state) {
  const Eigen::SparseMatrix<double> lower = CurveSystem(static_cast<int>(state.range(0)));
  const Eigen::MatrixX3d data = Eigen::MatrixX3d::Random(lower.rows(), 3);
  for (auto _ : state) {
    SparseSolver solver;
    solver.Factorise(lower);
    benchmark::DoNotOptimize(solver.Solve(data));
  }
}
BENCHMARK(SolveSparse)->Arg(1000)->Arg(100000)->Unit(benchmark::kMillisecond);

// The reference: the same system as a full matrix.
void SolveDense(benchmark::State& state) {
  const Eigen::MatrixXd lower = CurveSystem(static_cast<int>(state.range(0)));
  const Eigen::MatrixX3d data = Eigen::MatrixX3d::Random(lower.rows(), 3);
  for (auto _ : state) {
    const Eigen::MatrixX3d solution = lower.selfadjointView<Eigen::Lower>().llt().solve(data);
    benchmark::DoNotOptimize(solution.data());
  }
}
BENCHMARK(SolveDense)->Arg(1000)->Unit(benchmark::kMillisecond);

void CountComponents(benchmark::State& state) {
  const SkeletonGraph graph = Resolved<RandomSegments>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(graph.ComponentCount());
}
BENCHMARK(CountComponents)->Arg(100000)->Unit(benchmark::kMillisecond);

void ListComponents(benchmark::State& state) {
  const SkeletonGraph graph = Resolved<RandomSegments>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(ConnectedEdges(graph));
}
BENCHMARK(ListComponents)->Arg(100000)->Unit(benchmark::kMillisecond);

// The reference for both: the search of Boost Graph.
void LabelComponentsWithBoost(benchmark::State& state) {
  const SkeletonGraph graph = Resolved<RandomSegments>(state.range(0));
  for (auto _ : state) {
    const BoostView view(graph);
    std::vector<int> components(view.nodes().size());
    benchmark::DoNotOptimize(boost::connected_components(
        view,
        boost::make_iterator_property_map(components.begin(), get(boost::vertex_index, view))));
  }
}
BENCHMARK(LabelComponentsWithBoost)->Arg(100000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace curvefusion
