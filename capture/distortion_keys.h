#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "capture/distortion.h"
#include "capture/finding.h"
#include "kernel/camera.h"

namespace curvefusion {

/// The distortion that a camera of intrinsics.json names: k1, k2, p1, p2, k3 as keys, or
/// "distortion": [k1, k2, p1, p2], [k1, k2, p1, p2, k3] or [k1, k2, p1, p2, k3, k4, k5, k6]. Throws
/// Error(kBadInput), naming `where`, for other models and coefficients that are not zero, for what
/// is no number, and for coefficients that fold the image over.
Distortion ParseDistortion(const nlohmann::json& object, const PinholeCamera& camera,
                           const std::string& where);

/// Throws Error(kBadInput), naming `where`, for coefficients that fold the image over.
void RequireUnfolded(const PinholeCamera& camera, const Distortion& distortion,
                     const std::string& where);

/// Warns ("unknown-key") of keys of a camera in intrinsics.json that are not known and whose values
/// are numbers, lists or objects; text and flags are taken for remarks.
void ReportUnknownKeys(const nlohmann::json& object, const std::string& where,
                       const FindingHandler& on_finding);

}  // namespace curvefusion
