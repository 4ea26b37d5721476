// reconstruct SCAN CONFIG.toml SKELETON.json: the whole method, with settings from a file.
#include <curvefusion/check.h>
#include <curvefusion/config.h>
#include <curvefusion/error.h>
#include <curvefusion/reconstruct.h>
#include <curvefusion/sequence.h>
#include <curvefusion/skeleton_io.h>

#include <cstdio>

using namespace curvefusion;

// Hears of the run; an exception from here would end it.
class Printer : public PipelineObserver {
  void OnProgress(const std::string& stage, int64_t done, int64_t total) override {
    if (done == 0) std::printf("%s, %ld steps\n", stage.c_str(), static_cast<long>(total));
  }
};

int main(int argc, char** argv) try {
  if (argc != 4) throw Error(ErrorKind::kUsage, "usage: reconstruct SCAN CONFIG SKELETON");
  const Config config = ReadConfig({.profile = {}, .file = argv[2], .assignments = {}});
  Sequence sequence = OpenSequence(argv[1], PoseUse::kIfGiven, DepthUse::kIfGiven);
  UseFittedColourCamera(sequence);  // only where colour lies beside depth
  FindPoses(sequence, NoProgress);  // looks at those that are there, or tracks the camera
  Printer printer;
  const Reconstruction result = Reconstruct(sequence, config.pipeline, printer);
  WriteSkeleton(argv[3], result.skeleton);  // without curves where nothing thin was found
  std::printf("%d curves, %.2f m\n", result.skeleton.edge_count(), result.skeleton.TotalLength());
  for (const std::string& warning : result.warnings) std::printf("warning: %s\n", warning.c_str());
  return 0;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return ExitCode(error.kind());
}
