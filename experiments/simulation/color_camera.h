#pragma once

#include <string>
#include <vector>

#include "kernel/camera.h"
#include "kernel/options.h"

namespace curvefusion {

/// How a scan's colour images lie to its depth images. `kRegistered`: both from one place, as a
/// driver delivers them that warps one onto the other, but for a shift (SimulationOptions::
/// registration_error_px). The others leave the images as a colour camera of its own saw them:
/// `kExact` tells that camera in intrinsics.json, `kCalibrated` tells it with its centre off by
/// that shift, `kRaw` does not tell it, as raw recordings are published.
enum class Registration { kRegistered, kExact, kCalibrated, kRaw };

/// The colour camera and how it takes its pictures. The defaults are a camera without faults.
struct ColorOptions {
  Registration registration = Registration::kRegistered;
  /// The colour camera's own, where it has a place of its own: focal length and offset of the
  /// centre from the depth camera's in pixels of 640x480, and metres along +x from the depth camera
  /// (towards the projector). In raw recordings of a Kinect V1 and a PrimeSense whose colour was
  /// fitted to depth: 526 and 538 px, (2.5, -5) and (1.7, -5) px, 28 and 26 mm.
  double focal_length_px = 525;
  double center_u_px = 2;
  double center_v_px = -5;
  double baseline = 0.025;
  double exposure_time = 0;  ///< seconds in which the camera's motion blurs an image
  /// What automatic exposure and white balance do in the course of a scan: standard deviation of
  /// the exposure in stops, and of red and blue against green as a share.
  double exposure_drift = 0;
  double white_balance_drift = 0;
  double vignetting = 0;  ///< share of the light that is missing in the corners
};

void VisitOptions(ColorOptions& options, OptionVisitor& visitor);

/// `registered`, `exact`, `calibrated`, `raw`.
std::vector<std::string> RegistrationNames();
std::string RegistrationName(Registration registration);
/// Throws Error(kUsage) for another name.
Registration RegistrationOf(const std::string& name);

}  // namespace curvefusion
