#include "capture/intrinsics.h"

#include "tests/fuzz/fuzz_target.h"

using namespace curvefusion;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const InputFolder folder;
  const auto path = folder.Write("intrinsics.json", Text(data, size));
  AcceptErrors([&] { ReadIntrinsics(path, [](const CheckFinding&) {}); });
  AcceptErrors([&] { ReadRedwoodIntrinsics(path, [](const CheckFinding&) {}); });
  return 0;
}
