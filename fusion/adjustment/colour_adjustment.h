#pragma once

#include <cstdint>
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
enum class WireDepth {
  kShown,
  kNotShown,    ///< in wrong places, or there are no depth images
  kLookedPast,  ///< only what is behind them
};

/// What an adjustment starts from.
struct AdjustmentStart {
  std::vector<RigidTransform> T_world_given;    ///< of all frames, as the tracker gave them
  PoseErrors pose_errors = PoseErrors::kDrift;  ///< how these err
  WireDepth depth = WireDepth::kShown;
  /// The wires' colours as depth's thin pixels show them (WireColours); may be empty.
  std::vector<uint8_t> colours = {};
};

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
  double agreed_share = 0;       ///< of the accepted ones those at vertices that colour alone holds
  int depths = 0;                ///< depth measurements that held the movement along rays
  double depth_scatter = 0;      ///< of these about the curves, see DepthGauge
  double start_residual_px = 0;  ///< median distance of curve and strip before
  double residual_px = 0;        ///< and after
};

/// Whether curves came nearer to their strips; they do not where they lay on them before.
bool CameNearer(const ColourAdjustment& adjusted);

/// Bundle adjustment of curves and camera poses: vertices every few millimetres along the edges,
/// strips of wire colour found across them in the images of ChooseColourFrames (of vertices with
/// few strips also single edges), and Gauss-Newton over all vertices and poses, six rounds with a
/// shrinking search. Where curves lie so far beside their strips that the colours learned at their
/// places are the background's, that of which nothing came is done again from what images show
/// without them (LookUpFirst). `sequence` holds the poses that `skeleton` (with radii) was made
/// with. Deviation: CurveFusion uses colour for ghosts and radii only; depth errs by several
/// millimetres where colour edges are seen to a tenth of a pixel. Throws Error(kBadInput) for
/// images that cannot be decoded. Cost: .1 s a frame used for 3 m of wire.
ColourAdjustment AdjustToColours(const SkeletonGraph& skeleton, const Sequence& sequence,
                                 const AdjustmentStart& start,
                                 const ColourAdjustmentOptions& options);

}  // namespace curvefusion
