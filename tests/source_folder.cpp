#include "tests/source_folder.h"

namespace curvefusion {

std::filesystem::path SourceFolder() { return CURVEFUSION_SOURCE_DIR; }

}  // namespace curvefusion
