// Integration, raycast and meshing of a synthetic room.
#include <benchmark/benchmark.h>

#include "benchmarks/fusion/synthetic_room.h"
#include "fusion/volume/tsdf_volume.h"
#include "kernel/parallel.h"

namespace curvefusion {
namespace {

TsdfOptions VoxelsOf(int64_t millimetres) {
  TsdfOptions options;
  options.voxel_size = static_cast<double>(millimetres) * kMillimetre;
  return options;
}

// Arguments: voxel size in mm, threads.
void BM_Integrate(benchmark::State& state) {
  const ThreadLimit limit(static_cast<int>(state.range(1)));
  const PinholeCamera camera = KinectCamera();
  std::vector<DepthImage> frames;
  for (int i = 0; i < kFrames; ++i) frames.push_back(RenderDepth(Room(), camera, PoseOfFrame(i)));
  TsdfVolume volume(VoxelsOf(state.range(0)));
  for (int i = 0; i < kFrames; ++i) volume.Integrate(frames[i], camera, PoseOfFrame(i));
  int frame = 0;
  for (auto _ : state) {
    volume.Integrate(frames[frame], camera, PoseOfFrame(frame));
    frame = (frame + 1) % kFrames;
  }
  state.counters["blocks"] = static_cast<double>(volume.block_count());
  state.counters["MB"] = static_cast<double>(volume.memory_bytes()) * 1e-6;
}
BENCHMARK(BM_Integrate)
    ->ArgNames({"voxel_mm", "threads"})
    ->ArgsProduct({{5, 10}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

// Arguments: voxel size in mm, image height, threads.
void BM_Raycast(benchmark::State& state) {
  const PinholeCamera camera = KinectCamera();
  TsdfVolume volume(VoxelsOf(state.range(0)));
  for (int i = 0; i < kFrames; ++i) {
    volume.Integrate(RenderDepth(Room(), camera, PoseOfFrame(i)), camera, PoseOfFrame(i));
  }
  const ThreadLimit limit(static_cast<int>(state.range(2)));
  const PinholeCamera view = KinectCamera(static_cast<double>(state.range(1)) / 480);
  int frame = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(volume.Raycast(view, PoseOfFrame(frame)));
    frame = (frame + 1) % kFrames;
  }
}
BENCHMARK(BM_Raycast)
    ->ArgNames({"voxel_mm", "height", "threads"})
    ->ArgsProduct({{5, 10}, {240, 480}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

// Argument: voxel size in mm.
void BM_ExtractMesh(benchmark::State& state) {
  const PinholeCamera camera = KinectCamera();
  TsdfVolume volume(VoxelsOf(state.range(0)));
  for (int i = 0; i < kFrames; ++i) {
    volume.Integrate(RenderDepth(Room(), camera, PoseOfFrame(i)), camera, PoseOfFrame(i));
  }
  for (auto _ : state) benchmark::DoNotOptimize(volume.ExtractMesh());
}
BENCHMARK(BM_ExtractMesh)
    ->ArgName("voxel_mm")
    ->Arg(5)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace curvefusion
