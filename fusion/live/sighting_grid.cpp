#include "fusion/live/sighting_grid.h"

#include <algorithm>

namespace curvefusion {

void SightingGrid::AddFrame(const ObservedPoints& points) {
  ++frame_count_;
  for (size_t i = 0; i < points.size(); ++i) {
    const auto cell = static_cast<size_t>(cells_.Number(VoxelOf(points.positions[i], kCell)));
    if (cell == sightings_.size()) {
      sightings_.emplace_back();
      last_frame_.push_back(0);
    }
    if (last_frame_[cell] == frame_count_) continue;
    last_frame_[cell] = frame_count_;
    ++sightings_[cell].frames;
    sightings_[cell].views.Add(-points.viewing_rays[i]);
  }
}

Sightings SightingGrid::Around(const Vec3& p_world) const {
  Sightings around;
  const VoxelKey lowest = VoxelOf(p_world - Vec3::Constant(kCell / 2), kCell);
  for (int i = 0; i < 8; ++i) {
    const int cell =
        cells_.Find({lowest.x + (i & 1), lowest.y + (i >> 1 & 1), lowest.z + (i >> 2)});
    if (cell == VoxelNumbers::kNone) continue;
    around.frames = std::max(around.frames, sightings_[cell].frames);
    around.views += sightings_[cell].views;
  }
  return around;
}

}  // namespace curvefusion
