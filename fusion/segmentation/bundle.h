#pragma once

#include <vector>

#include "kernel/camera.h"
#include "kernel/geometry.h"
#include "kernel/image.h"
#include "kernel/observed_points.h"
#include "kernel/options.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

/// How frames are grouped and their points resampled, CurveFusion 4.1.
struct BundleOptions {
  int frames = 30;
  double voxel_size = 0.0025;
  int min_frames = 1;
};
void VisitOptions(BundleOptions& options, OptionVisitor& visitor);

/// The bundle difference set; as many of each as points.
struct BundlePoints {
  ObservedPoints points;
  std::vector<char> on_edge;  ///< whether a depth pixel merged into the point lies on a colour edge
  std::vector<int> voxels;    ///< handles of the points' voxels in their difference set
};

/// First and one past the last frame of every bundle. A last bundle of less than half the size
/// joins the one before it.
std::vector<std::pair<int, int>> SplitIntoBundles(int frame_count, int frames_per_bundle);

/// Gathers the image difference sets of a bundle on a regular grid; per occupied voxel it keeps the
/// mean position, the mean viewing ray, the number of pixels and of frames.
class BundleDifferenceSet {
 public:
  explicit BundleDifferenceSet(const BundleOptions& options) : options_(options) {}

  /// Adds the pixels of `mask`, lifted with `depth` and moved by T_bundle_camera. `on_edge` says
  /// which of them lie on a colour edge. Frames must be added one after the other: a voxel counts
  /// the calls that reached it.
  void AddFrame(const MaskImage& mask, const MaskImage& on_edge, const DepthImage& depth,
                const PinholeCamera& camera, const RigidTransform& T_bundle_camera);

  /// One point per voxel where at least min_frames different frames have a point in it or in one of
  /// its 26 neighbours.
  BundlePoints Points() const;

  /// What each frame saw of the voxels given (BundlePoints::voxels): one point per frame and voxel.
  std::vector<ObservedPoints> FramePoints(const std::vector<int>& voxels) const;

  int frame_count() const { return frame_count_; }
  size_t voxel_count() const { return voxels_.size(); }

 private:
  // What one frame saw of one voxel.
  struct Sighting {
    int frame = 0;
    int pixels = 0;
    Vec3 position_sum = Vec3::Zero();
    Vec3 ray_sum = Vec3::Zero();
  };
  struct Voxel {
    std::vector<Sighting> sightings;  // by ascending frame
    bool on_edge = false;
  };
  Voxel& VoxelAt(const Vec3& p_bundle);
  // Whether the voxel and its neighbours were seen in at least so many frames; `frames` is scratch.
  bool IsSeenAround(const VoxelKey& key, int min_frames, std::vector<int>& frames) const;

  BundleOptions options_;
  int frame_count_ = 0;
  VoxelNumbers numbers_;
  std::vector<Voxel> voxels_;
};

}  // namespace curvefusion
