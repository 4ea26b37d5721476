#include "capture/readers/readers.h"
#include "tests/fuzz/fuzz_target.h"

using namespace curvefusion;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const InputFolder folder;
  folder.Write("trajectory.log", Text(data, size));
  folder.Write("intrinsic.json",
               R"({"width":64,"height":48,"intrinsic_matrix":[36,0,0,0,36,0,32,24,1]})");
  std::filesystem::create_directories(folder.path() / "color");
  std::filesystem::create_directories(folder.path() / "depth");
  AcceptErrors([&] { ReadRedwood(folder.path(), [](const CheckFinding&) {}); });
  return 0;
}
