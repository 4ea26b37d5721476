#pragma once

#include <vector>

#include "capture/sequence.h"
#include "fusion/appearance/wire_posterior.h"
#include "fusion/reconstruction.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// What depth shows at the places of curves from colour, in all images in which nothing hides them.
struct PlacesInDepth {
  size_t looked = 0;
  size_t measured = 0;
  size_t free = 0;  ///< of those measured: what depth shows lies behind them
  size_t open = 0;  ///< free, or depth shows what lies behind on both sides of the curve

  /// Depth measures hardly any of the places: it has holes where the curves are.
  bool HaveHoles() const;
  /// Of all places where depth has holes, otherwise of those measured.
  double ShareOpen() const;
  /// Whether the curves run through open space, not along surfaces.
  bool AreOpen() const;
};

/// Looks at places along the curves in 20 of the frames. Throws Error(kBadInput) for an image that
/// cannot be read.
PlacesInDepth LookUpDepth(const Sequence& sequence, const SkeletonGraph& skeleton,
                          const std::vector<int>& frames);

/// How likely pixels of these frames' images show wire, zero where depth has no points of something
/// thin around them, at whatever distance.
std::vector<PosteriorImage> KeepThinInDepth(const Reconstruction& depth,
                                            const std::vector<int>& frames,
                                            std::vector<PosteriorImage> posteriors);

/// How much of the curves from colour lies, in 20 of the frames, where depth has points of
/// something thin, in whatever distance: a share of the places of all images.
double ShareThinInDepth(const Reconstruction& depth, const Reconstruction& colour,
                        const std::vector<int>& frames);

/// Whether the share is that of wires, not of what is painted on surfaces.
bool IsThinInDepth(double share);

/// How much of what depth has of something thin lies, in 20 of the frames, where the curves from
/// colour are, in whatever distance: a share of the points of all images.
double ShareOnCurves(const Reconstruction& depth, const Reconstruction& colour,
                     const std::vector<int>& frames);

}  // namespace curvefusion
