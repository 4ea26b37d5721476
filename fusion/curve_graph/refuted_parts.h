#pragma once

#include <functional>
#include <vector>

#include "graph/skeleton_graph.h"
#include "kernel/polyline.h"

namespace curvefusion {

// chosen: of places of nine scans (six of training, three shared ones) that lie on their wire .984
// have a greater share of the images with a strip that runs along the curve, of false ones .48.
constexpr double kMinStripShare = 0.4;

/// Which share of the images shows wire at each place of a curve.
using SharesOfCurve = std::function<std::vector<double>(const Polyline&)>;

/// Removes what images look past: stretches of edges that less than min_share of them show as wire,
/// with the stubs that remain. Short stretches at junctions stay, since those may lie beside where
/// wires meet, and so do short ones that are missed by little, and bends of long edges that .36
/// of that share shows; nor does a stretch go of which half is `shown_by_depth` (places, up to 3 mm
/// away). Returns the length removed, metres.
double DropRefutedParts(const SharesOfCurve& shares_of, double min_share,
                        const std::vector<Vec3>& shown_by_depth, SkeletonGraph& skeleton);

}  // namespace curvefusion
