#include "fusion/segmentation/openness.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "capture/depth_noise.h"
#include "capture/frame_stream.h"
#include "fusion/segmentation/rendered_points.h"

namespace curvefusion {

namespace {

// Chosen: the rendering for counting needs no more detail than a cell.
constexpr int kRenderDivisor = 4;
// Metres. Chosen: a cell and its neighbours hold several wires and the gaps between them.
constexpr double kCellSize = 0.02;
constexpr double kPassingDepth =
    0.02;  // metres; chosen: so far behind a surface a pixel has passed
// Where more pixels passed there is no surface but a grille. Measured on simulated scans: 99 % of
// the cells of real surfaces stay below .017 (noise, drift); rows of 5 mm wires show .02 to .2,
// those 8 mm apart less.
constexpr double kMaxShare = 0.025;
// Chosen: pixels of the rendering from a silhouette within which nothing is counted. They are 12
// pixels of the depth image, more than block matching fattens and poses drift.
constexpr int kMargin = 3;
// Derived, the tangent of 80 degrees: a surface seen at this angle from its normal rises over the
// margin by so many times its width; more is a silhouette.
constexpr double kSteepestSlope = 5.7;
// Fewer pixels tell no share: they are the fringes of what a few frames saw at grazing angles.
// Derived: a frame has about so many in a cell and its neighbours at 0.7 m.
constexpr int kMinPixels = 2000;

// The farthest rendered depth around a pixel; infinite where nothing is rendered.
float FarthestAround(const DepthImage& rendering, int u, int v) {
  float farthest = 0;
  for (int y = v - kMargin; y <= v + kMargin; ++y) {
    for (int x = u - kMargin; x <= u + kMargin; ++x) {
      if (!(rendering(x, y) > 0)) return std::numeric_limits<float>::infinity();
      farthest = std::max(farthest, rendering(x, y));
    }
  }
  return farthest;
}

}  // namespace

void OpennessGrid::AddFrame(const DepthImage& depth, const DepthImage& rendering,
                            const PinholeCamera& camera, const RigidTransform& T_world_camera) {
  const int factor = Divisor(depth, rendering);
  const double slope = kMargin * kSteepestSlope / camera.fx;
  for (int v = kMargin; v + kMargin < rendering.height(); ++v) {
    for (int u = kMargin; u + kMargin < rendering.width(); ++u) {
      const float surface = rendering(u, v);
      const float farthest = FarthestAround(rendering, u, v);
      if (!(surface > 0) || farthest > surface * (1 + slope)) continue;
      const float limit = farthest + static_cast<float>(std::max(
                                         kPassingDepth, kClearDeviations * DepthNoise(farthest)));
      Counts seen;
      for (int y = v * factor; y < (v + 1) * factor; ++y) {
        for (int x = u * factor; x < (u + 1) * factor; ++x) {
          seen.passed += depth(x, y) > limit;
          seen.ended += depth(x, y) > 0 && depth(x, y) <= limit;
        }
      }
      Counts& cell = counts_[VoxelOf(T_world_camera * camera.Unproject(u, v, surface), kCellSize)];
      cell.passed += seen.passed;
      cell.ended += seen.ended;
    }
  }
}

void OpennessGrid::Pool() {
  shares_.clear();
  for (const auto& entry : counts_) {
    const VoxelKey& key = entry.first;
    const Counts sum = SumAround(counts_, key);
    const int all = sum.passed + sum.ended;
    if (all >= kMinPixels) shares_[key] = static_cast<float>(sum.passed) / static_cast<float>(all);
  }
}

double OpennessGrid::Share(const Vec3& p_world) const {
  const auto it = shares_.find(VoxelOf(p_world, kCellSize));
  return it == shares_.end() ? 0.0 : it->second;
}

MaskImage OpennessGrid::Grilles(const DepthImage& rendering, const PinholeCamera& camera,
                                const RigidTransform& T_world_camera) const {
  MaskImage grilles(rendering.width(), rendering.height(), 0);
  if (shares_.empty()) return grilles;
  ForEachRenderedPoint(rendering, camera, T_world_camera, [&](int u, int v, const Vec3& p_world) {
    grilles(u, v) = Share(p_world) > kMaxShare;
  });
  return grilles;
}

OpennessGrid MeasureOpenness(const Sequence& sequence, const TsdfVolume& volume, int stride) {
  OpennessGrid grid;
  if (stride == 0) return grid;
  std::vector<int> frames;
  for (int i = 0; i < sequence.frame_count(); i += stride) frames.push_back(i);
  const PinholeCamera camera = sequence.depth_camera.Scaled(1.0 / kRenderDivisor);
  ForEachFrame(sequence, frames, {.depth = true, .color = false}, [&](const DecodedFrame& frame) {
    const RigidTransform& T_world_camera = sequence.frames[frame.index].T_world_camera;
    grid.AddFrame(frame.depth, volume.Raycast(camera, T_world_camera), camera, T_world_camera);
  });
  grid.Pool();
  return grid;
}

}  // namespace curvefusion
