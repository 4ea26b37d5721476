#include "capture/readers/containers.h"

#include <fmt/format.h>

namespace curvefusion {

std::string ExportRemedy(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  const std::string name = file.string();
  if (extension == ".sens") {
    return fmt::format(
        "a recording of BundleFusion or ScanNet; export it with ScanNet's SensReader (python "
        "reader.py --filename '{}' --output_path DIR --export_depth_images --export_color_images "
        "--export_poses --export_intrinsics) and read DIR, with an intrinsics.json of the values "
        "in "
        "DIR/intrinsic",
        name);
  }
  if (extension == ".r3d") {
    return fmt::format(
        "a recording of Record3D; it is a zip file (unzip '{}' -d DIR) of colour images, depth "
        "(LZFSE, float32, metres) and poses in 'metadata': write depth as 16-bit PNG in mm and "
        "poses "
        "and cameras as transforms.json (nerfstudio)",
        name);
  }
  if (extension == ".mkv") {
    return fmt::format(
        "a video, as Azure Kinect records; export it with Open3D's azure_kinect_mkv_reader.py "
        "(--input '{}' --output DIR), which writes color/, depth/ and intrinsic.json, and read DIR",
        name);
  }
  if (extension == ".bag") {
    return fmt::format(
        "a recording of RealSense or ROS; export it with Open3D (python3 -c \"import open3d; "
        "open3d.t.io.RGBDVideoReader.create('{}').save_frames('DIR')\"), which writes color/, "
        "depth/ "
        "and intrinsic.json, and read DIR",
        name);
  }
  return {};
}

}  // namespace curvefusion
