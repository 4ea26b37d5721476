#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "kernel/camera.h"
#include "kernel/geometry.h"
#include "kernel/image.h"
#include "kernel/options.h"
#include "kernel/triangle_mesh.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

/// VolumeFusion (Curless and Levoy 1996), CurveFusion 4.1. The volume only has to represent large
/// surfaces, so its voxels are coarse.
struct TsdfOptions {
  /// Metres, 0.001 to 0.1. CurveFusion 4.1 names no size; 10 mm segments equally well in half the
  /// time.
  double voxel_size = 0.005;
  /// Voxels before and behind a measurement that are sure to be stored, 2 to 20 (Curless and Levoy
  /// 1996: more than the noise, less than the thickness of what is scanned).
  int truncation_voxels = 4;
  /// Metres, 0.1 to 100. Measurements beyond are ignored; the noise of a Kinect exceeds 2 cm at 4
  /// m.
  double max_depth = 4.0;
  /// Observations, 1 to 65535. The mean of a voxel forgets beyond that many (KinectFusion, 2011).
  int max_weight = 255;
  /// Gigabytes (1e9 bytes), 0.01 to 1000. Integration refuses to grow beyond.
  double max_memory = 4.0;
};
void VisitOptions(TsdfOptions& options, OptionVisitor& visitor);

/// A block-sparse truncated signed distance field of any extent. Integration and raycast run in
/// parallel and give the same bits for any number of threads.
class TsdfVolume {
 public:
  /// With a box (metres), blocks that it does not meet are not stored. Throws Error(kUsage) for
  /// options out of their ranges.
  explicit TsdfVolume(const TsdfOptions& options,
                      const std::optional<Eigen::AlignedBox3d>& box = {});
  ~TsdfVolume();
  TsdfVolume(TsdfVolume&&) noexcept;
  TsdfVolume& operator=(TsdfVolume&&) noexcept;

  /// Adds one depth image (metres, 0 or NaN = invalid) taken by `camera` at `T_world_camera`.
  /// Voxels up to the truncation behind a measurement take its distance into their mean, stored
  /// ones farther in front of it count as free. Throws Error(kBadInput) for an image of another
  /// size than the camera's and for a pose that is not finite or out of reach, Error(kResource)
  /// beyond max_memory; the volume is then as before. Cost: linear in pixels and stored blocks.
  void Integrate(const DepthImage& depth, const PinholeCamera& camera,
                 const RigidTransform& T_world_camera);

  /// Depth (metres along the optical axis, 0 = no surface) of the first zero crossing from the
  /// outside to the inside that the ray of each pixel meets. Cells with an unobserved corner have
  /// no surface. Throws Error(kBadInput) for a pose that is not finite.
  DepthImage Raycast(const PinholeCamera& camera, const RigidTransform& T_world_camera) const;

  /// How solid it is `distance` metres behind the surfaces of a rendering (SolidityBehind). Throws
  /// Error(kUsage) for a distance that is not less than the truncation.
  DepthImage SolidityBehind(const DepthImage& rendering, const PinholeCamera& camera,
                            const RigidTransform& T_world_camera, double distance) const;

  /// Marching-cubes mesh of the zero crossing where it was observed; open where unobserved,
  /// otherwise manifold, oriented towards the observed free space.
  TriangleMesh ExtractMesh() const;

  double voxel_size() const;
  /// The mean signed distance at the sample voxel * voxel_size(), metres, positive in front of
  /// surfaces; NaN where never observed.
  double DistanceAt(const VoxelKey& voxel) const;

  size_t block_count() const;
  size_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace curvefusion
