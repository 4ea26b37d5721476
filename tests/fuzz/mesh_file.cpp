#include "meshing/io/mesh_io.h"
#include "tests/fuzz/fuzz_target.h"

using namespace curvefusion;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const InputFolder folder;
  const auto path = folder.Write(CURVEFUSION_FUZZ_FILE, Text(data, size));
  AcceptErrors([&] { ReadMesh(path); });
  return 0;
}
