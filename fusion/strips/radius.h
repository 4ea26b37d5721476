#pragma once

#include <vector>

#include "capture/sequence.h"
#include "graph/skeleton_graph.h"
#include "kernel/options.h"

namespace curvefusion {

/// Wire radius estimation, CurveFusion 4.3 ("Wire radius estimation"). Units, ranges and sources
/// stand in VisitOptions.
struct RadiusOptions {
  double sample_step = 0.010;
  double histogram_bin = 0.00025;
  int max_frames = 30;
  double gauge_strips = 100;
  double search_px = 10;
  double max_diameter = 0.025;
};
void VisitOptions(RadiusOptions& options, OptionVisitor& visitor);

/// The diameter measured at one place in one colour image.
struct StripWidth {
  EdgeId edge = 0;
  double arc_length = 0;  ///< metres from the front of the edge
  int frame = 0;          ///< in sequence.frames
  double diameter = 0;    ///< metres
};

/// Metres, of a curve whose radius was not measured; chosen: of a thin wire.
inline constexpr double kUnknownRadius = 0.002;

/// The radius at one place of an edge.
struct RadiusAt {
  double arc_length = 0;  ///< metres from the front of the edge
  double radius = 0;      ///< metres
};

/// What was measured along one edge.
struct EdgeRadius {
  EdgeId edge = 0;
  double radius = 0;  ///< metres; 0 = too few strips
  double error = 0;   ///< standard error, metres
  int count = 0;      ///< strips that agree with the radius
  /// Where the thickness clearly changes along the edge: ascending places, between which it changes
  /// linearly; empty otherwise.
  std::vector<RadiusAt> along;
};

/// Radii of a wire object.
struct RadiusEstimate {
  double global_radius = 0;  ///< the most prominent value, metres; 0 = not measurable
  /// What edges without enough strips are given, metres: that of the thinnest gauge, for thin wires
  /// stand close together and hide one another; the global one where no wire is measured.
  double unmeasured_radius = 0;
  std::vector<EdgeRadius> edges;   ///< one per edge, ascending
  std::vector<StripWidth> strips;  ///< every accepted strip
};

/// Measures the width of the wires' strips in the colour images: sample points of the skeleton
/// (world frame) are projected into at most options.max_frames of `frames` (indices into
/// sequence.frames, evenly thinned), the strip found near each is measured across the curve and
/// converted to metres. The most prominent value of all is the global radius; each edge gets the
/// value that the strips of its wire (all edges that go straight on into one another) agree on, or,
/// where that clearly differs, its own, shrunk towards the gauge of the wires like it. An edge is
/// cut into stretches of 30 mm, and where their diameters differ by 30 % and more than their errors
/// explain, its radius varies. Places where another curve of the skeleton lies within 1.5 widths
/// are left out; wires that are hardly anywhere free of others are measured between those that
/// cross them. Throws Error(kBadInput) for images that cannot be decoded. Cost: 10 ms a frame for 3
/// m of wire.
RadiusEstimate EstimateRadius(const SkeletonGraph& skeleton, const Sequence& sequence,
                              const std::vector<int>& frames, const RadiusOptions& options);

/// Sets the radius at every vertex: each edge's own, at that place of the edge where it changes
/// along it; unmeasured_radius where it has none. Does nothing where nothing was measured at all
/// (estimate.global_radius == 0).
void AssignRadii(const RadiusEstimate& estimate, SkeletonGraph& skeleton);

}  // namespace curvefusion
