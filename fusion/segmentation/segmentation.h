#pragma once

#include <functional>

#include "capture/sequence.h"
#include "fusion/funnel.h"
#include "fusion/nets/net_wires.h"
#include "fusion/segmentation/bundle.h"
#include "fusion/segmentation/colour_gate.h"
#include "fusion/segmentation/depth_opening.h"
#include "fusion/segmentation/difference_set.h"
#include "fusion/segmentation/floating_sheets.h"
#include "fusion/segmentation/ghost_removal.h"
#include "fusion/segmentation/openness.h"
#include "fusion/volume/tsdf_volume.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// Everything that decides which points are thin, CurveFusion 4.1.
struct SegmentationOptions {
  int render_divisor = 1;
  int openness_stride = 0;
  DepthOpeningOptions opening;
  DifferenceSetOptions difference;
  double min_measured_share = 0;
  ColourGateOptions gate;
  double max_array_spacing = 0;
  int max_frame_points = 0;
  double edge_tolerance_px = 1;
  BundleOptions bundle;
  GhostRemovalOptions ghosts;
};
void VisitOptions(SegmentationOptions& options, OptionVisitor& visitor);

/// What has to be known of a whole sequence before its bundles are segmented.
struct SegmentationModel {
  int frame_stride = 1;                ///< every so many-th frame is segmented
  bool is_background_measured = true;  ///< otherwise it is out of range, or cut off
  OpennessGrid openness;
  SheetGrid sheets;           ///< wire arrays that depth shows as surfaces
  double array_spacing = 0;   ///< of their wires, metres; 0 where there are none
  double array_diameter = 0;  ///< of their wires, metres, roughly
  WireColours colours;
  Nets nets;
};

/// Learns it from frames spread over the sequence, against the volume of all frames.
/// Throws Error(kBadInput) for an image that cannot be read.
SegmentationModel LearnSegmentation(const Sequence& sequence, const TsdfVolume& volume,
                                    const SegmentationOptions& options);

/// What was found in one bundle.
struct SegmentedBundle {
  ObservedPoints difference_set;  ///< before ghosts were removed, in the frame of the first camera
  ObservedPoints points;          ///< after, likewise
  std::vector<ObservedPoints> frames;  ///< what each frame saw of `points`, likewise; nothing where
                                       ///< it was left out
  RigidTransform T_world_bundle;       ///< pose of the first camera
  PointFunnel funnel;
};

/// Segments frames [first, last) of a sequence against the volume of all frames. `on_frame` is
/// called for every one that is done, from any thread.
/// Throws Error(kBadInput) for an image that cannot be read.
SegmentedBundle SegmentBundle(const Sequence& sequence, int first, int last,
                              const TsdfVolume& volume, const SegmentationModel& model,
                              const SegmentationOptions& options,
                              const std::function<void()>& on_frame);

}  // namespace curvefusion
