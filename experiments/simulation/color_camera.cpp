#include "experiments/simulation/color_camera.h"

#include <algorithm>

#include "kernel/error.h"

namespace curvefusion {

void VisitOptions(ColorOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"color_focal_length", "px", 100, 2000,
                 "Focal length of a colour camera of its own, at 640x480; Kinect V1."},
                options.focal_length_px);
  visitor.Visit({"color_center_u", "px", -50, 50,
                 "Its centre to the right of the depth camera's; Kinect V1."},
                options.center_u_px);
  visitor.Visit(
      {"color_center_v", "px", -50, 50, "Its centre below the depth camera's; Kinect V1."},
      options.center_v_px);
  visitor.Visit({"color_baseline", "m", -0.1, 0.1,
                 "From the depth camera to it, towards the projector; Kinect V1."},
                options.baseline);
  visitor.Visit(
      {"exposure_time", "s", 0, 0.033, "Time in which motion blurs an image; own choice."},
      options.exposure_time);
  visitor.Visit({"exposure_drift", "stops", 0, 3,
                 "Standard deviation of the exposure over a scan; own choice."},
                options.exposure_drift);
  visitor.Visit({"white_balance_drift", "", 0, 0.5,
                 "Standard deviation of red and blue against green over a scan; own choice."},
                options.white_balance_drift);
  visitor.Visit({"vignetting", "", 0, 0.9, "Share of light missing in the corners; own choice."},
                options.vignetting);
}

std::vector<std::string> RegistrationNames() {
  return {"registered", "exact", "calibrated", "raw"};
}

std::string RegistrationName(Registration registration) {
  return RegistrationNames()[static_cast<size_t>(registration)];
}

Registration RegistrationOf(const std::string& name) {
  const std::vector<std::string> names = RegistrationNames();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw Error(ErrorKind::kUsage, "no registration is called '" + name + "'; did you mean '" +
                                       NearestName(name, names) + "'?");
  }
  return static_cast<Registration>(found - names.begin());
}

}  // namespace curvefusion
