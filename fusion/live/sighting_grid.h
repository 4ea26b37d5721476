#pragma once

#include <vector>

#include "fusion/live/view_directions.h"
#include "kernel/geometry.h"
#include "kernel/observed_points.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

/// What frames saw near a place.
struct Sightings {
  int frames = 0;  ///< that saw a thin part there
  ViewDirections views;
};

/// How many frames saw each place of thin parts, and from where. Takes memory for the places that
/// were seen, however many frames saw them.
class SightingGrid {
 public:
  /// Metres. Chosen: a curve lies before or behind the points of its wire by less than half of it.
  static constexpr double kCell = 0.01;

  /// Counts a frame for every cell in which it saw a point (world frame).
  void AddFrame(const ObservedPoints& points);

  /// Of the eight cells around a place: the frames of the one that was seen most, the views of all.
  Sightings Around(const Vec3& p_world) const;

  int cell_count() const { return cells_.size(); }

 private:
  VoxelNumbers cells_;
  std::vector<Sightings> sightings_;
  std::vector<int> last_frame_;  ///< that was counted for the cell
  int frame_count_ = 0;
};

}  // namespace curvefusion
