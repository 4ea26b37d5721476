#include "fusion/volume/tsdf_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <optional>
#include <vector>

#include "fusion/volume/marching_cubes.h"
#include "fusion/volume/raycast.h"
#include "fusion/volume/space_behind.h"
#include "fusion/volume/surface_cells.h"
#include "fusion/volume/tsdf_integration.h"
#include "fusion/volume/voxel_blocks.h"
#include "kernel/error.h"

namespace curvefusion {

void VisitOptions(TsdfOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"voxel_size", "m", 0.001, 0.1,
                 "Distance of the samples of the volume, which represents large surfaces only. "
                 "CurveFusion 4.1."},
                options.voxel_size);
  visitor.Visit({"truncation_voxels", "voxels", 2, 20,
                 "Distances are stored so far before and behind surfaces. Curless and Levoy 1996."},
                options.truncation_voxels);
  visitor.Visit(
      {"max_depth", "m", 0.1, 100, "Measurements beyond are ignored by the volume. Sensor range."},
      options.max_depth);
  visitor.Visit({"max_weight", "frames", 1, 65535,
                 "The mean of a voxel forgets beyond that many observations. KinectFusion 2011."},
                options.max_weight);
  visitor.Visit(
      {"max_memory", "GB", 0.01, 1000, "The volume refuses to grow beyond. Protects the machine."},
      options.max_memory);
}

namespace {

// Rejects values outside the range that VisitOptions states.
class RangeCheck : public OptionVisitor {
 public:
  void BeginSection(const char*) override {}
  void Visit(const OptionInfo& info, double& value) override { Check(info, value); }
  void Visit(const OptionInfo& info, int& value) override { Check(info, value); }
  void Visit(const OptionInfo&, bool&) override {}

 private:
  static void Check(const OptionInfo& info, double value) {
    if (value >= info.min && value <= info.max) return;
    throw Error(ErrorKind::kUsage, fmt::format("volume.{} = {} {}: must be from {} to {}",
                                               info.name, value, info.unit, info.min, info.max));
  }
};

TsdfOptions Checked(TsdfOptions options) {
  RangeCheck check;
  VisitOptions(options, check);
  return options;
}

void CheckPose(const RigidTransform& T_world_camera) {
  if (!T_world_camera.matrix().allFinite()) {
    throw Error(ErrorKind::kBadInput,
                "camera pose contains a value that is not a number: check the trajectory");
  }
}

}  // namespace

struct TsdfVolume::Impl {
  TsdfOptions options;
  TsdfScale scale;
  std::optional<Eigen::AlignedBox3d> box;
  VoxelBlockGrid grid;

  void CheckReach(const PinholeCamera& camera, const RigidTransform& T_world_camera) const;
  std::vector<VoxelKey> WithinBox(std::vector<VoxelKey> keys) const;
  void Allocate(const std::vector<VoxelKey>& keys);
  const std::vector<SurfaceBlock>& SurfaceBlocks() const;
  void ForgetSurface() { surface_.reset(); }

 private:
  // Found by the first raycast after an integration; raycasts may run at the same time.
  mutable std::mutex surface_mutex_;
  mutable std::optional<std::vector<SurfaceBlock>> surface_;
};

// No measurement may fall on a block whose key the grid cannot hold.
void TsdfVolume::Impl::CheckReach(const PinholeCamera& camera,
                                  const RigidTransform& T_world_camera) const {
  const double corner_ray = std::max(camera.Unproject(-1, -1, 1).norm(),
                                     camera.Unproject(camera.width, camera.height, 1).norm());
  const double reach = T_world_camera.translation().cwiseAbs().maxCoeff() +
                       2 * corner_ray * (options.max_depth + scale.truncation);
  const double limit = (VoxelBlockGrid::kMaxKey - 2.0) * kBlockSide * scale.voxel_size;
  if (reach < limit) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("camera at {:.6g} {:.6g} {:.6g} m is out of the volume's reach of {:.6g} "
                          "m: check the unit of the trajectory or use a larger voxel_size",
                          T_world_camera.translation().x(), T_world_camera.translation().y(),
                          T_world_camera.translation().z(), limit));
}

std::vector<VoxelKey> TsdfVolume::Impl::WithinBox(std::vector<VoxelKey> keys) const {
  if (!box) return keys;
  const double side = kBlockSide * scale.voxel_size;
  std::erase_if(keys, [&](const VoxelKey& key) {
    const Vec3 low = side * Vec3(key.x, key.y, key.z);
    return !box->intersects(Eigen::AlignedBox3d(low, low + Vec3::Constant(side)));
  });
  return keys;
}

void TsdfVolume::Impl::Allocate(const std::vector<VoxelKey>& keys) {
  const double bytes = static_cast<double>(grid.size() + keys.size()) *
                       static_cast<double>(VoxelBlockGrid::BytesPerBlock());
  if (bytes > options.max_memory * 1e9) {
    throw Error(ErrorKind::kResource,
                fmt::format("the volume needs {} blocks of {:.4g} mm, more than the {:.4g} GB of "
                            "max_memory: use a voxel_size larger than {:.4g} mm, a max_depth "
                            "smaller than {:.4g} m, or raise max_memory",
                            grid.size() + keys.size(), kBlockSide * scale.voxel_size * 1000,
                            options.max_memory, scale.voxel_size * 1000, options.max_depth));
  }
  for (const VoxelKey& key : keys) grid.Insert(key);
}

const std::vector<SurfaceBlock>& TsdfVolume::Impl::SurfaceBlocks() const {
  const std::lock_guard<std::mutex> lock(surface_mutex_);
  if (!surface_) surface_ = FindSurfaceBlocks(grid);
  return *surface_;
}

TsdfVolume::TsdfVolume(const TsdfOptions& options, const std::optional<Eigen::AlignedBox3d>& box)
    : impl_(std::make_unique<Impl>()) {
  impl_->options = Checked(options);
  impl_->scale = {options.voxel_size, options.truncation_voxels * options.voxel_size};
  impl_->box = box;
}

TsdfVolume::~TsdfVolume() = default;
TsdfVolume::TsdfVolume(TsdfVolume&&) noexcept = default;
TsdfVolume& TsdfVolume::operator=(TsdfVolume&&) noexcept = default;

void TsdfVolume::Integrate(const DepthImage& depth, const PinholeCamera& camera,
                           const RigidTransform& T_world_camera) {
  CheckPose(T_world_camera);
  if (depth.width() != camera.width || depth.height() != camera.height) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("depth image of {} x {} pixels does not fit its camera of {} x {}: "
                            "check the intrinsics",
                            depth.width(), depth.height(), camera.width, camera.height));
  }
  impl_->CheckReach(camera, T_world_camera);
  const IntegrationFrame frame(depth, camera, T_world_camera, impl_->options.max_depth);
  impl_->Allocate(impl_->WithinBox(FindMissingBlocks(frame, impl_->scale, impl_->grid)));
  UpdateBlocks(frame, impl_->scale, impl_->options.max_weight, impl_->grid);
  impl_->ForgetSurface();
}

DepthImage TsdfVolume::Raycast(const PinholeCamera& camera,
                               const RigidTransform& T_world_camera) const {
  CheckPose(T_world_camera);
  return RaycastBlocks(impl_->grid, impl_->SurfaceBlocks(), impl_->scale.voxel_size, camera,
                       T_world_camera);
}

DepthImage TsdfVolume::SolidityBehind(const DepthImage& rendering, const PinholeCamera& camera,
                                      const RigidTransform& T_world_camera, double distance) const {
  if (distance >= impl_->scale.truncation) {
    throw Error(ErrorKind::kUsage,
                fmt::format("the volume stores distances up to {} m behind surfaces: "
                            "segmentation.solid_depth = {} m must be less, or "
                            "volume.truncation_voxels larger",
                            impl_->scale.truncation, distance));
  }
  return curvefusion::SolidityBehind(impl_->grid, impl_->scale, rendering, camera, T_world_camera,
                                     distance);
}

TriangleMesh TsdfVolume::ExtractMesh() const {
  return MarchingCubes(impl_->grid, impl_->scale.voxel_size);
}

double TsdfVolume::voxel_size() const { return impl_->scale.voxel_size; }

double TsdfVolume::DistanceAt(const VoxelKey& voxel) const {
  const int block = impl_->grid.Find(BlockOf(voxel));
  if (block == VoxelBlockGrid::kNone) return std::numeric_limits<double>::quiet_NaN();
  return impl_->scale.truncation *
         static_cast<double>(impl_->grid.block(block).tsdf[IndexInBlock(voxel)]);
}

size_t TsdfVolume::block_count() const { return static_cast<size_t>(impl_->grid.size()); }

size_t TsdfVolume::memory_bytes() const { return sizeof(Impl) + impl_->grid.memory_bytes(); }

}  // namespace curvefusion
