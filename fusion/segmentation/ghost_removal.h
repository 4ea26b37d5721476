#pragma once

#include "fusion/funnel.h"
#include "fusion/segmentation/bundle.h"
#include "kernel/options.h"

namespace curvefusion {

/// Which clusters of a bundle difference set are no physical thing, CurveFusion 4.1 "Removing
/// 'ghost' points".
struct GhostRemovalOptions {
  double cluster_radius = 0.01;
  int core_points = 4;
  int min_cluster_points = 10;
  double isolation_distance = 0.1;
  double isolated_share = 2;
  double verified_share = 0.2;
};
void VisitOptions(GhostRemovalOptions& options, OptionVisitor& visitor);

/// The points of clusters that are large enough, not isolated, and verified by colour edges.
///
/// The paper drops clusters "more than 10 cm away from any other cluster". Read literally that
/// deletes an object that is alone because the segmentation was clean, so isolation is measured to
/// larger clusters only: the largest one always stays, and so do other objects (three tenths of the
/// largest one's points or more, of which `isolated_share` lie on colour edges) and parts between
/// which wires have no depth (a twentieth or more, of which nine tenths do, too). What each rule
/// drops is added to `funnel`, if any.
BundlePoints RemoveGhosts(const BundlePoints& bundle, const GhostRemovalOptions& options,
                          PointFunnel* funnel = nullptr);

}  // namespace curvefusion
