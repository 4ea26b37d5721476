#include "capture/trajectory.h"

#include "tests/fuzz/fuzz_target.h"

using namespace curvefusion;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const InputFolder folder;
  const auto path = folder.Write("trajectory.txt", Text(data, size));
  AcceptErrors([&] { ReadTumTrajectory(path, [](const CheckFinding&) {}); });
  AcceptErrors([&] { ReadPoseMatrix(path, [](const CheckFinding&) {}); });
  return 0;
}
