// Following the strips of curves through one image of 640x480.
#include <benchmark/benchmark.h>

#include "fusion/strips/strip_tracking.h"

namespace curvefusion {
namespace {

// Upright wires of 6 px, so many pixels apart.
void BM_TrackStrips(benchmark::State& state) {
  const double spacing_px = static_cast<double>(state.range(0));
  PosteriorImage image(640, 480, 0);
  std::vector<ProjectedSample> samples;
  int edge = 0;
  for (double u = 30; u < 610; u += spacing_px, ++edge) {
    for (int v = 0; v < 480; ++v)
      for (int du = -3; du < 3; ++du) image(static_cast<int>(u) + du, v) = 230;
    for (int v = 10; v < 470; v += 3) {
      ProjectedSample sample;
      sample.edge = edge;
      sample.index = (v - 10) / 3;
      sample.pixel = Vec2(u + 1.3, v);
      sample.tangent = Vec2(0, 1);
      sample.normal = Vec2(-1, 0);
      sample.metres_per_px = 0.001;
      sample.clearance_px = spacing_px;
      samples.push_back(sample);
    }
  }
  const std::vector<double> radii(samples.size(), 0.003);
  for (auto _ : state) benchmark::DoNotOptimize(TrackStrips(image, samples, radii, 10));
  state.counters["samples"] = static_cast<double>(samples.size());
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(samples.size()));
}
BENCHMARK(BM_TrackStrips)->Arg(20)->Arg(60)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace curvefusion
