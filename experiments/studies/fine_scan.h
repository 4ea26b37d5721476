#pragma once

#include "experiments/studies/study.h"

namespace curvefusion {

/// Diameter of the thinnest wire of which the paper has a scan: by an Artec Space Spider
/// (CurveFusion 5, Effect of different sensors).
inline constexpr double kFineWire = 1.5 * kMillimetre;

/// A scan that only such a scanner can make: the breadholder as much smaller as its wire of 5 mm is
/// thicker than kFineWire, 66 mm wide, which the scanner's field of view holds. Poses are true: the
/// scanner's own program aligns its frames to less than what it resolves.
SimulationOptions FineScan(const StudyRequest& request, uint64_t seed, const FrameCounts& frames);

/// The config of a case with a scan. Of a FineScan all lengths of the paper profile, which are made
/// for wires of some 5 mm, are scaled like the object, and depth with nothing behind it stays, as
/// the scanner's range ends behind the object. The best profile is as it is.
Config ConfigOfScan(const StudyRequest& request, Profile profile, const SimulationOptions& scan);

}  // namespace curvefusion
