#include "experiments/pictures/png.h"

#include "capture/png.h"
#include "kernel/atomic_file.h"

namespace curvefusion {

void WritePng(const std::filesystem::path& path, const ColorImage& picture) {
  WriteBytesAtomically(path, EncodePng(picture));
}

}  // namespace curvefusion
