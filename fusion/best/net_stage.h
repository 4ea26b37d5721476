#pragma once

#include "fusion/nets/net_curves.h"
#include "fusion/nets/net_wires.h"
#include "fusion/reconstruction.h"
#include "fusion/stage_progress.h"

namespace curvefusion {

/// Deviation: traces the wires of nets, which lie so close that neither depth nor single images
/// tell them apart, by all images together.
NetCurves TraceNets(const Nets& nets, const StageReporter& reporter, Reconstruction& result);

/// Gives edges that lie on wires of nets and were not measured the radius of the wire.
void MeasureNetWires(const NetCurves& nets, Reconstruction& result);

}  // namespace curvefusion
