#pragma once

#include <unordered_map>
#include <unordered_set>

#include "kernel/camera.h"
#include "kernel/geometry.h"
#include "kernel/image.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

/// The pixels of those surfaces of a rendering that hang together with nothing: parts of `kept` (a
/// rendering after opening) behind nearly all of whose outline there is free space. A wire array
/// that depth shows as one sheet looks so; tables, walls and what stands on them do not.
/// `rendering` is the same before opening. Linear in pixels.
MaskImage FloatingSheets(const DepthImage& kept, const DepthImage& rendering);

/// Where in space floating sheets are, from several renderings.
class SheetGrid {
 public:
  /// Counts the pixels of a rendering that are part of a floating sheet, and all.
  void AddFrame(const MaskImage& floating, const DepthImage& rendering, const PinholeCamera& camera,
                const RigidTransform& T_world_camera);

  /// Marks the cells that with their neighbours are sheet in a good part of what was added so far:
  /// in some views a sheet lies before something at its own distance.
  void Pool();

  /// Whether there are no marked cells.
  bool empty() const { return sheets_.empty(); }

  /// Whether a point lies in a marked cell.
  bool Contains(const Vec3& p_world) const;

  /// 1 at the pixels of a rendering that lie in marked cells.
  MaskImage Mask(const DepthImage& rendering, const PinholeCamera& camera,
                 const RigidTransform& T_world_camera) const;

 private:
  static constexpr double kCell = 0.02;  // metres; chosen: two wires that depth does not resolve
  struct Counts {
    int floating = 0;
    int all = 0;
    Counts& operator+=(const Counts& other) {
      floating += other.floating;
      all += other.all;
      return *this;
    }
  };
  std::unordered_map<VoxelKey, Counts, VoxelKeyHash> counts_;
  std::unordered_set<VoxelKey, VoxelKeyHash> sheets_;
};

}  // namespace curvefusion
