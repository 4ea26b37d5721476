#include "meshing/io/mesh_io.h"
#include "tests/fuzz/fuzz_target.h"

using namespace curvefusion;

// lib3MF 1.8 leaves some hundred bytes in libzip for each file it reads, whatever is in it.
extern "C" const char* __lsan_default_suppressions() { return "leak:libzip.so"; }

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const InputFolder folder;
  const auto path = folder.Write("mesh.3mf", Text(data, size));
  AcceptErrors([&] { ReadMesh(path); });
  return 0;
}
