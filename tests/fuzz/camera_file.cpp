#include "capture/image_file.h"
#include "capture/readers/readers.h"
#include "tests/fuzz/fuzz_target.h"

using namespace curvefusion;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const InputFolder folder;
  const auto file = folder.Write(CURVEFUSION_FUZZ_FILE, Text(data, size));
  AcceptErrors([&] {
    for (const SequenceFrame& frame :
         CURVEFUSION_FUZZ_READER(file, [](const CheckFinding&) {}).frames) {
      AcceptErrors([&] { DecodeDepthImage(frame.depth_path, frame.depth_part); });
      AcceptErrors([&] { DecodeColorImage(frame.color_path, frame.color_part); });
    }
  });
  return 0;
}
