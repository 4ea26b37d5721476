#include "experiments/metrics/truth.h"
#include "tests/fuzz/fuzz_target.h"

using namespace curvefusion;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const InputFolder folder;
  const auto path = folder.Write("curves.json", Text(data, size));
  AcceptErrors([&] { ReadTruth(path); });
  return 0;
}
