#pragma once

#include <array>
#include <vector>

#include "fusion/best/best_options.h"
#include "fusion/live/sighting_grid.h"
#include "fusion/registration/carried_points.h"
#include "graph/skeleton_graph.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// What a scan has shown so far, world frame: all that a snapshot is made from.
struct LiveEvidence {
  CarriedPoints carried{CarriedPointsOptions()};  ///< of all bundles
  SightingGrid sightings;                         ///< of single frames
  double ray_noise_ratio = 1;  ///< of noise along the viewing rays to that across them
};

/// How well a curve is known.
struct CurveSightings {
  int frames = 0;     ///< of those looked at, that saw the middling place of the curve
  double spread = 0;  ///< radians around the curve between the outermost views, likewise
  std::array<bool, 2> free_ends{};  ///< whether nothing meets the curve at its first and last point
  double evidence = 0;              ///< from 0 to 1, see EvidenceOf
  Vec3 at = Vec3::Zero();           ///< the middle of the curve
  /// Where a view of `at` would add most, towards the camera, of unit length; zero where the curve
  /// was seen from enough sides, or from none.
  Vec3 look_from = Vec3::Zero();
};

/// The curves so far, without radii.
struct LiveSnapshot {
  SkeletonGraph graph;
  std::vector<CurveSightings> curves;  ///< one per edge, in the order of graph.Edges()
};

/// 1 for a curve that enough frames saw, from enough sides; less in proportion for the rarer of
/// the two.
double EvidenceOf(int frames, double spread);

/// The curves of all points so far, contracted at once as the best profile does after its bundles.
/// Costs about linear in the points, however many frames they came from.
LiveSnapshot MakeSnapshot(const LiveEvidence& evidence, const BestOptions& options);

}  // namespace curvefusion
