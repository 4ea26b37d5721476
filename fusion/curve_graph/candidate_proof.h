#pragma once

#include <array>
#include <string>
#include <vector>

#include "capture/sequence.h"
#include "fusion/curve_graph/strip_views.h"
#include "graph/skeleton_graph.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// What decides whether a stretch of a curve that colour images propose is a wire.
struct CandidateStretch {
  std::array<Vec3, 3> places;  ///< its first, middle and last point
  double length = 0;           ///< metres
  double middle_evidence = 0;  ///< of how near strips' middles are, an image that shows one
  bool is_free = false;        ///< something farther lies behind most of it
  double colour_log_odds = 0;  ///< ColourLogOdds
  double found_places = 0;     ///< near it, a millimetre
};

/// A table, a stretch a row: three points in metres, then all that CandidateStretch holds.
std::string StretchesCsv(const std::vector<CandidateStretch>& stretches);

/// What KeepProvenCandidates tells of the curves.
struct CandidateProof {
  std::vector<CandidateStretch> stretches;  ///< all that it judged
  /// Points of curves that are wires even if they hang together with nothing: long ones before free
  /// space whose strips' middles lie near them.
  std::vector<Vec3> stand_alone;
};

/// Leaves of curves that colour images propose what they prove. A stretch stays where most images
/// show a strip along it and it is rather a wire than not, by how many `places` were found along it
/// (FindColourCandidates), how near the strips' middles lie, and the colours beside it; with
/// nothing farther behind it in depth images, which fill the gaps between close wires, these must
/// tell that no surface goes on there (ColourLogOdds). Then every strip speaks for one curve only:
/// that with most evidence is taken first and explains its strips in `views`, and a curve stays
/// only where enough of the others are left to it. `radius` (metres) is that of all curves; what
/// `known` ones hide in images is left out. Throws Error(kBadInput) for an image that cannot be
/// decoded.
CandidateProof KeepProvenCandidates(const Sequence& sequence, const SkeletonGraph& known,
                                    const std::vector<Vec3>& places, double radius,
                                    StripViews& views, SkeletonGraph& curves);

}  // namespace curvefusion
