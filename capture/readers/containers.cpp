#include "capture/readers/containers.h"

#include <fmt/format.h>

namespace curvefusion {

std::string ExportRemedy(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  const std::string name = file.string();
  if (extension == ".r3d") {
    return fmt::format(
        "a recording of Record3D; it is a zip file (unzip '{}' -d DIR) of colour images, depth "
        "(LZFSE, float32, metres) and poses in 'metadata': write depth as 16-bit PNG in mm and "
        "poses "
        "and cameras as transforms.json (nerfstudio)",
        name);
  }
  return {};
}

}  // namespace curvefusion
