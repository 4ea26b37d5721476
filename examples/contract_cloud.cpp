// contract_cloud CLOUD SKELETON: the curves of a cloud in metres (PLY, PCD, XYZ).
#include <cstdio>

#include <curvefusion/cloud.h>
#include <curvefusion/contract.h>
#include <curvefusion/error.h>
#include <curvefusion/skeleton_io.h>

using namespace curvefusion;

int main(int argc, char** argv) try {
  if (argc != 3) throw Error(ErrorKind::kUsage, "usage: contract_cloud CLOUD SKELETON");
  const SkeletonGraph curves = CurvesOfCloud(ReadCloud(argv[1]), {.radius = 0.002});
  std::printf("%d curves, %.3f m\n", curves.edge_count(), curves.TotalLength());
  for (const std::string& loss : ExportSkeleton(argv[2], curves)) std::puts(loss.c_str());
  return 0;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return ExitCode(error.kind());
}
