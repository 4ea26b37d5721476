#include "capture/readers/readers.h"
#include "tests/fuzz/fuzz_target.h"

using namespace curvefusion;

// The camera matrix and the odometry are divided by a 0 byte.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const InputFolder folder;
  for (const char* name : {"rgb", "depth"}) {
    std::filesystem::create_directories(folder.path() / name);
    folder.Write(std::string(name) + "/000000.png", "no image");
  }
  const std::string_view text = Text(data, size);
  const size_t middle = std::min(text.find(char(0)), text.size());
  folder.Write("camera_matrix.csv", text.substr(0, middle));
  folder.Write("odometry.csv", text.substr(middle < text.size() ? middle + 1 : middle));
  AcceptErrors([&] { ReadStrayScanner(folder.path(), [](const CheckFinding&) {}); });
  return 0;
}
