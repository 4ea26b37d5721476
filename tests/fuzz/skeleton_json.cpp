#include <cstdlib>
#include <string>

#include "graph/io/graph_io.h"
#include "tests/fuzz/fuzz_target.h"

using namespace curvefusion;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::string written;
  AcceptErrors(
      [&] { written = SkeletonToJson(SkeletonFromJson(std::string(Text(data, size)), "input")); });
  // What is written can be read, and is the same.
  if (!written.empty() && SkeletonToJson(SkeletonFromJson(written, "output")) != written)
    std::abort();
  return 0;
}
