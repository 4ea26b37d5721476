#pragma once

#include <string>
#include <vector>

#include "fusion/adjustment/colour_adjustment.h"
#include "fusion/registration/alignment.h"
#include "fusion/registration/carried_points.h"
#include "fusion/registration/frame_registration.h"
#include "fusion/segmentation/segmentation.h"
#include "fusion/silhouettes/silhouette_topology.h"
#include "fusion/silhouettes/view_evidence.h"
#include "fusion/strips/radius.h"
#include "fusion/volume/tsdf_volume.h"
#include "graph/contraction/ridge_skeleton.h"
#include "kernel/options.h"

namespace curvefusion {

/// What depth images are used for.
enum class DepthRole {
  kAuto,        ///< kWires, but kBackground where depth shows wires in wrong places; kNone where
                ///< there is no depth
  kWires,       ///< curves come from depth
  kBackground,  ///< surfaces, scale, poses and what hides what; curves come from colour
  kNone,        ///< nothing: curves come from colour, and scale from the poses
};

/// What the roles are called, in their order: "auto", "wires", "background", "none".
const std::vector<std::string>& DepthRoleNames();
const std::string& DepthRoleName(DepthRole role);

struct DepthOptions {
  DepthRole use = DepthRole::kAuto;
  bool hold_to_surfaces = false;
  bool magnify_fine_wires = false;
};
void VisitOptions(DepthOptions& options, OptionVisitor& visitor);

/// The options of every stage of the best profile. Start from DefaultBestOptions: in a
/// default-constructed one most extensions of the paper are off.
struct BestOptions {
  TsdfOptions volume;
  int volume_stride = 1;
  SegmentationOptions segmentation;
  CarriedPointsOptions carried;
  AlignmentOptions registration;
  FrameRegistrationOptions frames;
  double axis_depth = 0;
  double min_linearity = 0.3;
  double resolved_spacing = 0;
  RidgeOptions ridge;
  RadiusOptions radius;
  ColourAdjustmentOptions colour_adjustment;
  DepthOptions depth;
  SilhouetteOptions silhouettes;
  ViewEvidenceOptions evidence;
};
void VisitOptions(BestOptions& options, OptionVisitor& visitor);

/// The documented defaults of the best profile.
BestOptions DefaultBestOptions();

}  // namespace curvefusion
