#pragma once

#include <string>
#include <vector>

#include "capture/sequence.h"
#include "fusion/adjustment/curve_pose_solver.h"
#include "fusion/appearance/wire_posterior.h"
#include "graph/skeleton_graph.h"
#include "kernel/options.h"

namespace curvefusion {

/// Refinement of curves and poses in the colour images. Units, ranges and sources stand in
/// VisitOptions.
struct ColourAdjustmentOptions {
  bool enabled = false;
  double vertex_step = 3 * kMillimetre;
  int frame_stride = 3;
  double axis_depth = 0.85;
  bool edges = true;
};
void VisitOptions(ColourAdjustmentOptions& options, OptionVisitor& visitor);

/// Whether depth images show wires where they are. Where they do not, colour images alone count.
enum class WireDepth { kShown, kNotShown };

/// What an adjustment came to. Where it could not help (`skipped` tells why), skeleton and poses
/// are those that were given.
struct ColourAdjustment {
  SkeletonGraph skeleton;
  /// Of all frames; those of `frames` fit their colour images, which lie beside their depth images
  /// by some tenths of a pixel each (shutters are not in step).
  std::vector<RigidTransform> T_world_camera;
  Vec2 color_shift_px = Vec2::Zero();      ///< by which the colour camera's principal point is off
  std::string skipped;                     ///< why nothing was changed; empty where it was
  std::vector<int> frames;                 ///< that were used, ascending
  std::vector<PosteriorImage> posteriors;  ///< of each of them, as learned last
  int strips = 0;                          ///< accepted in the last round
  double accepted_share = 0;               ///< of the strips looked for
  int depths = 0;                          ///< depth measurements that held the movement along rays
  double depth_scatter = 0;                ///< of these about the curves, see DepthGauge
  double start_residual_px = 0;            ///< median distance of curve and strip before
  double residual_px = 0;                  ///< and after
};

/// Whether curves came nearer to their strips; they do not where they lay on them before.
bool CameNearer(const ColourAdjustment& adjusted);

/// Bundle adjustment of curves and camera poses: vertices every few millimetres along the edges,
/// strips of wire colour found across them in the images of ChooseColourFrames (of vertices with
/// few strips also single edges), and Gauss-Newton over all vertices and poses, six rounds with a
/// shrinking search. `sequence` holds the poses that `skeleton` (with radii) was made with,
/// `T_world_given` those of the tracker, which err as `pose_errors` says. Deviation: CurveFusion
/// uses colour for ghosts and radii only; depth errs by several millimetres where colour edges are
/// seen to a tenth of a pixel. Throws Error(kBadInput) for images that cannot be decoded. Cost: .1
/// s a frame used for 3 m of wire.
ColourAdjustment AdjustToColours(const SkeletonGraph& skeleton, const Sequence& sequence,
                                 const std::vector<RigidTransform>& T_world_given,
                                 const ColourAdjustmentOptions& options,
                                 WireDepth depth = WireDepth::kShown,
                                 PoseErrors pose_errors = PoseErrors::kDrift);

}  // namespace curvefusion
