#pragma once

#include <filesystem>
#include <optional>

#include "kernel/camera.h"

namespace curvefusion {

/// A colour camera and its place, as intrinsics.json tells them.
struct ColourReference {
  PinholeCamera color_camera;
  RigidTransform T_color_depth = RigidTransform::Identity();
  bool is_told = true;  ///< by the scan's own intrinsics.json, to some pixels
};

/// The colour camera that a scan really has: of a simulated one by its truth, of the recordings
/// `kitchen` (andyzeng/tsdf-fusion-python) and `mug` (hongtaowu67/TSDFfusion-cpu) as it was fitted
/// to depth and colour edges by other means. None where it is not known.
std::optional<ColourReference> ReferenceOf(const std::filesystem::path& scan,
                                           const PinholeCamera& depth_camera);

/// How far apart two colour cameras see what depth shows at a distance (metres): pixels of a 640 px
/// wide image, mean over the depth image.
double ColourOffset(const PinholeCamera& depth_camera, const ColourReference& a,
                    const ColourReference& b, double distance);

}  // namespace curvefusion
