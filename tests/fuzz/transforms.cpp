#include "capture/readers/readers.h"
#include "tests/fuzz/fuzz_target.h"

using namespace curvefusion;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const InputFolder folder;
  folder.Write("transforms.json", Text(data, size));
  AcceptErrors([&] { ReadNerfstudio(folder.path(), [](const CheckFinding&) {}); });
  return 0;
}
