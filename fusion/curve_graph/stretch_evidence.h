#pragma once

#include <string>
#include <vector>

#include "capture/sequence.h"
#include "fusion/curve_graph/colour_beside.h"
#include "fusion/strips/radius.h"
#include "graph/edge_parts.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// What was measured of a stretch of an edge, some centimetres long: all that decides whether it is
/// a wire. Shares of depth images are means over the directions from which the stretch was seen, so
/// that many images from one side do not count as many.
struct StretchEvidence {
  EdgeId edge = 0;
  EdgePart part;       ///< points of the edge
  double length = 0;   ///< metres
  Vec3 middle;         ///< world frame
  int images = 0;      ///< depth images that looked there
  int directions = 0;  ///< steps of 10 degrees around the curve from which they did
  double seen = 0;     ///< share of looks with a depth that agrees
  double past = 0;     ///< share that measured what is behind it
  double open = 0;  ///< of what was seen: farther things on both sides (half where one is unknown)
  double same = 0;  ///< of what was seen: its surface goes on, on one side or both
  double most_same = 0;        ///< the same from the worst direction
  double open_directions = 0;  ///< steps of 10 degrees from which mostly both sides were open
  double width = 0;  ///< metres, median of the connected depth where both sides were open; 0 = none
  double pixel = 0;  ///< metres that a pixel is wide there, mean
  int strips = 0;    ///< in colour images, that agree with the edge's diameter
  double coverage = 0;     ///< share of the length near such strips
  double diameter = 0;     ///< of the edge by its strips, metres; 0 = not measured
  ColourChange beside;     ///< of the colours beside it
  double on_surfaces = 0;  ///< median of the least change beside lines on the scan's surfaces; 0 =
                           ///< not known
};

/// Cuts every edge into stretches and looks at each in at most `max_frames` evenly spread depth
/// images and half as many colour images; `radii` are those of the skeleton (world frame). What
/// curves `in_front` hide in colour images is left out. Stretches by edge, then along it. Throws
/// Error(kBadInput) for an image that cannot be decoded. Cost: places (every 4 mm) x frames x 100
/// pixels.
std::vector<StretchEvidence> CollectEvidence(const SkeletonGraph& skeleton,
                                             const RadiusEstimate& radii, const Sequence& sequence,
                                             int max_frames, const SkeletonGraph& in_front);

/// A table of all evidence, a stretch a row: first, middle and last point in metres, then all that
/// StretchEvidence holds.
std::string EvidenceCsv(const SkeletonGraph& skeleton,
                        const std::vector<StretchEvidence>& evidence);

}  // namespace curvefusion
