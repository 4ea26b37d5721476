// Opening of renderings of a synthetic room.
#include <benchmark/benchmark.h>

#include "benchmarks/fusion/synthetic_room.h"
#include "fusion/segmentation/depth_opening.h"

namespace curvefusion {
namespace {

// Argument: image height.
void BM_OpenDepth(benchmark::State& state) {
  const PinholeCamera camera = KinectCamera(static_cast<double>(state.range(0)) / 480);
  std::vector<DepthImage> frames;
  for (int i = 0; i < kFrames; ++i) frames.push_back(RenderDepth(Room(), camera, PoseOfFrame(i)));
  int frame = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(OpenDepth(frames[frame], camera, {}, {}));
    frame = (frame + 1) % kFrames;
  }
}
BENCHMARK(BM_OpenDepth)->ArgName("height")->Arg(240)->Arg(480)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace curvefusion
