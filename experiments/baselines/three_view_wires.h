#pragma once

#include <numbers>
#include <vector>

#include "experiments/baselines/curve_candidates.h"
#include "experiments/baselines/silhouette_maps.h"
#include "graph/skeleton_graph.h"
#include "kernel/progress.h"

namespace curvefusion {

// Liu, Ceylan, Lin, Wang, Mitra 2017, "Image-based Reconstruction of Wire Art" (ACM TOG 36(4)), as
// far as its curve selection. Our own program, after the published description and the settings of
// the authors' program for its nine examples, of which it has the median or what is called general:
// - Curves are the centre lines of the silhouette, split where they meet.
// - For each pixel of a curve, the epipolar line in a second image is cut with all curves there;
//   matches of one pixel after the other that continue each other are a candidate in space.
// - A candidate of more than 10 points is kept where its images lie beside the curves of each of
//   the three images (SupportRule) and run along them (cosine .8 in the mean). Two images have it
//   by construction: the third decides.
// - The six ordered pairs of images come one after the other, each along pixels only that no
//   candidate explains so far, so that there are few duplicates.
// - Candidates farther from the nearest other than they are long are discarded.
// - Of what is left, each stretch of an image's curve gets one candidate: that with a good image,
//   ends near those of others, and a smooth way on.
//
// What is read into it, or different:
// - A match continues those before where it lies within 5 pixels of where they lead; in the
//   authors' program, within 5 pixels of the last. There all candidates of a curve end wherever the
//   number of matches changes, too; here none does, so that candidates are longer and better tried.
// - Intersections at less than 14.5 degrees (sine .25) are not used, and a candidate goes straight
//   over up to 16 pixels of them. The authors' program fits a spline over 4 to 10 pixels either
//   side of an epipolar tangent.
// - The selection is greedy (below); the authors solve a relaxed quadratic program and round.
// - Left out are clean-ups of isolated and weakly supported curves, which have their own thresholds
//   in each example, and the decomposition into wires (a multiple travelling salesman problem):
//   what CurveFusion says of the method is about the curves that are there before it.

/// What three views give: an edge a curve, in the world frame.
struct ThreeViewWires {
  SkeletonGraph candidates;  ///< all that have support, before the selection
  SkeletonGraph selected;
};

/// The angle between each two of three views, radians: the median over six of the authors' examples
/// is 36 degrees (13 to 85).
inline constexpr double kAngleOfThreeViews = 36 * std::numbers::pi / 180;

/// Three cameras that look at a point from so far: the directions to any two of them are `angle`
/// apart, all as far from `away`, the unit direction from the point to their middle. Their
/// baselines are at least 15 degrees off the horizontal and the vertical of an object whose z is
/// up: epipolar lines along its wires would find nothing.
std::vector<RigidTransform> ThreePosesAround(const Vec3& center, const Vec3& away, double distance,
                                             double angle = kAngleOfThreeViews);

/// The selection: again and again the part of a candidate with the greatest value, where its pixels
/// are a run of more than 10 of an image's curve that has no selected one yet. The value is its
/// pixels, over 1 plus what is amiss: how far its images lie beside the curves, in pixels (root
/// mean square); the distance of its nearer end from an end of a selected one, in its own length,
/// at most 1; the turn there, (1 - cosine) / 2. Throws Error(kBadInput) unless there are three
/// views.
ThreeViewWires WiresOfThreeViews(const std::vector<SilhouetteMap>& views, SupportRule rule,
                                 const Progress& progress);

}  // namespace curvefusion
