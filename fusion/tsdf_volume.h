#pragma once

#include <memory>

#include "kernel/camera.h"
#include "kernel/geometry.h"
#include "kernel/image.h"
#include "kernel/options.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// VolumeFusion (Curless and Levoy 1996), CurveFusion 3.1.
struct TsdfOptions {
  double voxel_size = 0.005;
  int truncation_voxels = 4;
  double max_depth = 4.0;
};
void VisitOptions(TsdfOptions& options, OptionVisitor& visitor);

/// A block-sparse truncated signed distance field of any extent. Integration and raycast run in
/// parallel and give the same bits for any number of threads.
class TsdfVolume {
 public:
  explicit TsdfVolume(const TsdfOptions& options);
  ~TsdfVolume();
  TsdfVolume(TsdfVolume&&) noexcept;
  TsdfVolume& operator=(TsdfVolume&&) noexcept;

  /// Adds one depth image (metres, 0 = invalid) taken by `camera` at `T_world_camera`.
  void Integrate(const DepthImage& depth, const PinholeCamera& camera,
                 const RigidTransform& T_world_camera);

  /// Depth (metres along the optical axis, 0 = no surface) of the zero crossing seen by a camera.
  DepthImage Raycast(const PinholeCamera& camera, const RigidTransform& T_world_camera) const;

  /// Marching-cubes mesh of the zero crossing where it was observed; open where unobserved.
  TriangleMesh ExtractMesh() const;

  size_t block_count() const;
  size_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace curvefusion
