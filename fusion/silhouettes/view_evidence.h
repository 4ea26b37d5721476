#pragma once

#include <vector>

#include "capture/sequence.h"
#include "graph/skeleton_graph.h"
#include "kernel/options.h"

namespace curvefusion {

/// On what the places of a skeleton rest.
struct ViewEvidenceOptions {
  int max_frames = 60;
  double tolerance = 0.02;
  /// Chosen on training scans and validation cage 201: a wire lost is worse than a false curve left
  /// (docs/proof.md#selection).
  double min_probability = 0.2;
};
void VisitOptions(ViewEvidenceOptions& options, OptionVisitor& visitor);

/// In how many depth images a place was looked for (it lies in the image and nothing stands before
/// it), and in how many of these something was measured there.
struct ViewCount {
  int looked = 0;
  int seen = 0;
};

/// The views of every point of an edge's curve, in its order.
struct EdgeViews {
  EdgeId edge = 0;
  std::vector<ViewCount> points;
};

struct ViewEvidence {
  int frames = 0;                ///< that were looked through
  std::vector<EdgeViews> edges;  ///< all, ascending
};

/// Looks for every point of the skeleton (world frame) in at most options.max_frames depth images,
/// evenly spread. A point is seen where a depth within the wire's outline, or a pixel beside it,
/// agrees with the wire's near side within options.tolerance; it is hidden, and the image does not
/// count, where all depths there are nearer; it was looked for in vain otherwise, also where
/// nothing was measured. Throws Error(kBadInput) for an image that cannot be decoded. Cost: points
/// x frames.
ViewEvidence CountViews(const SkeletonGraph& skeleton, const Sequence& sequence,
                        const ViewEvidenceOptions& options);

/// The medians of both counts; zeros for no points.
ViewCount TypicalViews(const std::vector<ViewCount>& points);

/// The places that depth alone shows: seen in at least 8 images and a quarter of those that look
/// there, with no other curve within 10 mm, beside which depth runs together.
std::vector<Vec3> PlacesShownByDepth(const ViewEvidence& evidence, const SkeletonGraph& skeleton);

/// Gives every point of the skeleton the number of images that saw it as its observation count.
void AssignObservations(const ViewEvidence& evidence, SkeletonGraph& skeleton);

}  // namespace curvefusion
