#pragma once

#include <filesystem>
#include <optional>

#include "capture/distortion.h"
#include "capture/finding.h"
#include "kernel/camera.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// The cameras of a sequence. A camera of width 0 is unknown.
struct Intrinsics {
  PinholeCamera depth_camera;
  PinholeCamera color_camera;  ///< the depth camera where the file names no other
  Distortion depth_distortion;
  Distortion color_distortion;  ///< that of the depth camera where the file names no other camera
  RigidTransform T_color_depth = RigidTransform::Identity();
  std::optional<double> depth_scale;  ///< depth units per metre, where the file says so
};

/// Reads intrinsics.json:
/// ```
/// {"width":640, "height":480, "fx":580, "fy":580, "cx":319.5, "cy":239.5, "depth_scale":5000,
///  "color_camera": {"width":1280, "height":1024, "fx":1050, "fy":1050, "cx":639.5, "cy":511.5},
///  "T_color_depth": [[1,0,0,0.025],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}
/// ```
/// Widths and focal lengths in pixels, principal points with pixel (0, 0) at the centre of the
/// top-left pixel; depth_scale, color_camera and T_color_depth (metres, 4 rows or 16 numbers row by
/// row) may be missing. Both cameras may have k1, k2, p1, p2, k3 or "distortion": [k1, k2, p1, p2,
/// k3, k4, k5, k6], shorter where the last are 0. Reports what cannot be: missing or wrong values, a
/// principal point outside the image, other lens models; warns of unknown keys.
Intrinsics ReadIntrinsics(const std::filesystem::path& path, const FindingHandler& on_finding);

/// Reads the intrinsic.json of Open3D: width, height and a column-major 3x3 `intrinsic_matrix`;
/// optional depth_scale. Reports like ReadIntrinsics.
Intrinsics ReadRedwoodIntrinsics(const std::filesystem::path& path,
                                 const FindingHandler& on_finding);

}  // namespace curvefusion
