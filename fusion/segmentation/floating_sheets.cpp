#include "fusion/segmentation/floating_sheets.h"

#include <cmath>
#include <utility>
#include <vector>

#include "fusion/segmentation/depth_opening.h"
#include "fusion/segmentation/rendered_points.h"

namespace curvefusion {

namespace {

// Metres. A step of depth between neighbours up to which a surface goes on; derived: that of
// DepthOpeningOptions.
constexpr auto kStep = static_cast<float>(DepthOpeningOptions().discontinuity);
// Metres; chosen: what is so far behind an outline is another surface, with free space before it.
constexpr float kBehind = 0.03f;
// Chosen, of the outline: so much may hang together with what lies beside it, and so much must be
// free. The rest is hidden by something nearer, or lies at the image's border.
constexpr double kMaxAttached = 0.2;
constexpr double kMinFree = 0.6;
// Chosen: parts of which more would fit into the image are specks. At .7 m so large is a wire 40 mm
// long.
constexpr size_t kMaxPartsInImage = 768;
// Chosen, of a cell's pixels in all renderings: in some views a sheet lies before something at its
// own distance.
constexpr double kMinSheetShare = 0.1;

using Pixel = std::pair<int, int>;

// What lies beyond the pixels around a part of a rendering.
struct Outline {
  int free = 0;
  int attached = 0;
  int all = 0;
};

void AddToOutline(float depth, float kept_beside, float rendered_beside, Outline& outline) {
  ++outline.all;
  outline.free += !(rendered_beside > 0) || rendered_beside > depth + kBehind;
  outline.attached += kept_beside > depth && kept_beside <= depth + kBehind;
}

// The pixels that hang together with a first one, marked as visited.
std::vector<Pixel> TakePart(const DepthImage& kept, const DepthImage& rendering, Pixel first,
                            MaskImage& visited, Outline& outline) {
  std::vector<Pixel> part = {first};
  visited(first.first, first.second) = 1;
  for (size_t i = 0; i < part.size(); ++i) {
    const auto [u, v] = part[i];
    for (const auto& [du, dv] : kPixelsBeside) {
      if (!kept.Contains(u + du, v + dv)) {
        ++outline.all;
        continue;
      }
      const float depth = kept(u, v), beside = kept(u + du, v + dv);
      if (!(beside > 0) || std::abs(beside - depth) > kStep) {
        AddToOutline(depth, beside, rendering(u + du, v + dv), outline);
      } else if (!visited(u + du, v + dv)) {
        visited(u + du, v + dv) = 1;
        part.emplace_back(u + du, v + dv);
      }
    }
  }
  return part;
}

}  // namespace

MaskImage FloatingSheets(const DepthImage& kept, const DepthImage& rendering) {
  MaskImage floating(kept.width(), kept.height(), 0);
  MaskImage visited(kept.width(), kept.height(), 0);
  const size_t least = kept.size() / kMaxPartsInImage;
  for (int v = 0; v < kept.height(); ++v) {
    for (int u = 0; u < kept.width(); ++u) {
      if (!(kept(u, v) > 0) || visited(u, v)) continue;
      Outline outline;
      const std::vector<Pixel> part = TakePart(kept, rendering, {u, v}, visited, outline);
      if (part.size() < least || outline.attached > kMaxAttached * outline.all ||
          outline.free < kMinFree * outline.all) {
        continue;
      }
      for (const auto& [x, y] : part) floating(x, y) = 1;
    }
  }
  return floating;
}

void SheetGrid::AddFrame(const MaskImage& floating, const DepthImage& rendering,
                         const PinholeCamera& camera, const RigidTransform& T_world_camera) {
  ForEachRenderedPoint(rendering, camera, T_world_camera, [&](int u, int v, const Vec3& p_world) {
    Counts& cell = counts_[VoxelOf(p_world, kCell)];
    ++cell.all;
    cell.floating += floating(u, v);
  });
}

void SheetGrid::Pool() {
  sheets_.clear();
  for (const auto& entry : counts_) {
    const VoxelKey& key = entry.first;
    const Counts sum = SumAround(counts_, key);
    if (sum.floating > kMinSheetShare * sum.all) sheets_.insert(key);
  }
}

bool SheetGrid::Contains(const Vec3& p_world) const {
  return sheets_.contains(VoxelOf(p_world, kCell));
}

MaskImage SheetGrid::Mask(const DepthImage& rendering, const PinholeCamera& camera,
                          const RigidTransform& T_world_camera) const {
  MaskImage mask(rendering.width(), rendering.height(), 0);
  if (sheets_.empty()) return mask;
  ForEachRenderedPoint(rendering, camera, T_world_camera,
                       [&](int u, int v, const Vec3& p_world) { mask(u, v) = Contains(p_world); });
  return mask;
}

}  // namespace curvefusion
