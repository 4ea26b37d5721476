// Integration and raycast of a synthetic room: a wall and a floor, a box, a ball and a wire cage.
#include "fusion/tsdf_volume.h"

#include <benchmark/benchmark.h>

#include "kernel/parallel.h"
#include "tests/fusion/analytic_depth.h"

namespace curvefusion {
namespace {

constexpr int kFrames = 12;

DepthAlongRay Room() {
  DepthAlongRay room = Union(Plane(Vec3::UnitZ(), 1.8), Plane(Vec3::UnitY(), 0.6));
  room = Union(room, Box({-0.5, 0.2, 1.1}, {-0.1, 0.6, 1.5}));
  room = Union(room, Sphere({0.35, 0.35, 1.2}, 0.25));
  for (int i = 0; i < 6; ++i) {
    const double x = -0.5 + 0.2 * i;
    room = Union(room, Box({x, -0.5, 0.8}, {x + 0.005, 0.5, 0.805}));
  }
  return room;
}

RigidTransform PoseOfFrame(int frame) {
  const double angle = 0.5 * frame / kFrames - 0.25;
  return LookAt(Vec3(1.4 * std::sin(angle), -0.1, 1.2 - 1.4 * std::cos(angle)), {0, 0.1, 1.2});
}

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
