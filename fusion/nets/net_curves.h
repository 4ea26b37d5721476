#pragma once

#include <vector>

#include "capture/sequence.h"
#include "fusion/nets/net_wires.h"
#include "graph/skeleton_graph.h"
#include "kernel/polyline.h"

namespace curvefusion {

/// Chosen: metres between curves that are one wire of a net, less than half of what is between two.
inline constexpr double kSameWire = 0.003;

/// A wire of a net.
struct NetWire {
  Polyline points;
  double diameter = 0;  ///< metres; 0 = not measured
};

/// The wires of nets, and how many metres of other curves gave way to them.
struct NetCurves {
  std::vector<NetWire> wires;
  double length = 0;    ///< metres
  double replaced = 0;  ///< metres
};

/// Looks for the wires of nets in all images together and has them take the place of what the
/// skeleton has there. Those not measured are given `radius`, metres. Throws Error(kBadInput) for
/// an image that cannot be read.
NetCurves AddNetCurves(const Sequence& sequence, const Nets& nets, double radius,
                       SkeletonGraph& skeleton);

}  // namespace curvefusion
