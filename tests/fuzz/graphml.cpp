#include <cstdlib>
#include <string>

#include "graph/io/graph_io.h"
#include "tests/fuzz/fuzz_target.h"

using namespace curvefusion;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const InputFolder folder;
  const auto path = folder.Write("graph.graphml", Text(data, size));
  std::string json;
  AcceptErrors([&] {
    const SkeletonGraph graph = ReadSkeleton(path);
    ExportSkeleton(path, graph);
    json = SkeletonToJson(graph);
  });
  // What is written can be read, and is the same.
  if (!json.empty() && SkeletonToJson(ReadSkeleton(path)) != json) std::abort();
  return 0;
}
