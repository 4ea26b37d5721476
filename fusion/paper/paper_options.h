#pragma once

#include "fusion/paper/colour_edge_samples.h"
#include "fusion/paper/ghost_clusters.h"
#include "fusion/paper/skeleton_fusion.h"
#include "fusion/paper/surface_removal.h"
#include "fusion/paper/wire_radius.h"
#include "fusion/volume/tsdf_volume.h"
#include "graph/contraction/l1_contraction.h"
#include "kernel/options.h"

namespace curvefusion {

/// Frames of a bundle, and the grid of its points, CurveFusion 4.1.
struct PaperBundleOptions {
  /// 1 to 100000. "k = 30 works well for most of the models we have tested."
  int frames = 30;
  /// Metres, 0.0005 to 0.05. "We resample this merged point set ... using a 3D regular grid": no
  /// number; derived: as far apart as the samples of the contraction, which is what the grid is
  /// for.
  double voxel_size = 3 * kMillimetre;
};
void VisitOptions(PaperBundleOptions& options, OptionVisitor& visitor);

/// Everything that the paper's method can be told.
struct PaperOptions {
  /// Derived: distances of 3 voxels of 5 mm are less than 17 mm, the least spacing of wires that
  /// the paper resolves. A volume fills gaps that its truncation spans, and what it fills is a
  /// surface.
  TsdfOptions volume = {.truncation_voxels = 3};
  PaperBundleOptions bundle;
  SurfaceRemovalOptions surfaces;
  CurveEdgeOptions edges;
  GhostClusterOptions ghosts;
  L1Options l1;
  SkeletonFusionOptions fusion;
  WireRadiusOptions radius;
};
void VisitOptions(PaperOptions& options, OptionVisitor& visitor);

}  // namespace curvefusion
