#include "fusion/paper/paper_options.h"

namespace curvefusion {

void VisitOptions(PaperBundleOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"frames", "frames", 1, 100000,
                 "Consecutive frames merged before a skeleton is extracted. CurveFusion 4.1, k."},
                options.frames);
  visitor.Visit({"voxel_size", "m", 0.0005, 0.05,
                 "Grid on which the merged points are resampled. CurveFusion 4.1 gives no value."},
                options.voxel_size);
}

void VisitOptions(PaperOptions& options, OptionVisitor& visitor) {
  visitor.BeginSection("volume");
  VisitOptions(options.volume, visitor);
  visitor.BeginSection("bundle");
  VisitOptions(options.bundle, visitor);
  visitor.BeginSection("surfaces");
  VisitOptions(options.surfaces, visitor);
  visitor.BeginSection("colour_edges");
  VisitOptions(options.edges, visitor);
  visitor.BeginSection("ghosts");
  VisitOptions(options.ghosts, visitor);
  visitor.BeginSection("l1_contraction");
  VisitOptions(options.l1, visitor);
  visitor.BeginSection("alignment");
  VisitOptions(options.fusion.alignment, visitor);
  visitor.BeginSection("fusion");
  VisitOptions(options.fusion, visitor);
  visitor.BeginSection("radius");
  VisitOptions(options.radius, visitor);
}

}  // namespace curvefusion
