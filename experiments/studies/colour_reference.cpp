#include "experiments/studies/colour_reference.h"

#include <nlohmann/json.hpp>

#include "experiments/simulation/scan_settings.h"
#include "kernel/json_input.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

ColourReference Recorded(double f, double cx, double cy, double tx, double ty) {
  ColourReference reference{{640, 480, f, f, cx, cy}};
  reference.T_color_depth.translation() = Vec3(tx, ty, 0);
  reference.is_told = false;
  return reference;
}

// Registered and calibrated images are shifted against what intrinsics.json tells.
ColourReference Simulated(const fs::path& scan, const PinholeCamera& depth_camera) {
  const SimulationOptions settings = ReadScanSettings(scan / "truth" / "settings.json");
  const fs::path path = scan / "truth" / "scene.json";
  const nlohmann::json scene = ParseJson(ReadFile(path), path.string());
  const auto& camera = scene.at("color_camera");
  ColourReference reference{{camera.at("width"), camera.at("height"), camera.at("fx"),
                             camera.at("fy"), camera.at("cx"), camera.at("cy")}};
  const auto& position = scene.at("color_position");
  for (int axis = 0; axis < 3; ++axis) {
    reference.T_color_depth.translation()[axis] = -position.at(axis).get<double>();
  }
  const Registration registration = settings.color.registration;
  reference.is_told = registration != Registration::kRaw;
  if (registration == Registration::kRegistered || registration == Registration::kCalibrated) {
    const double scale = reference.color_camera.fx / depth_camera.fx;  // as it is simulated
    reference.color_camera.cx += scale * scene.at("color_shift_px").at(0).get<double>();
    reference.color_camera.cy += scale * scene.at("color_shift_px").at(1).get<double>();
  }
  return reference;
}

}  // namespace

std::optional<ColourReference> ReferenceOf(const fs::path& scan,
                                           const PinholeCamera& depth_camera) {
  if (fs::exists(scan / "truth" / "scene.json")) return Simulated(scan, depth_camera);
  const std::string name = scan.filename().string();
  if (name == "kitchen") return Recorded(526, 322.5, 235, -0.028, 0.01);
  if (name == "mug") return Recorded(538.1, 317.73, 238.73, -0.02597, -0.00209);
  return std::nullopt;
}

double ColourOffset(const PinholeCamera& depth_camera, const ColourReference& a,
                    const ColourReference& b, double distance) {
  constexpr int kStep = 16;  // pixels
  double sum = 0;
  int count = 0;
  for (int v = kStep / 2; v < depth_camera.height; v += kStep) {
    for (int u = kStep / 2; u < depth_camera.width; u += kStep) {
      const Vec3 p_depth = depth_camera.Unproject(u, v, distance);
      sum += (a.color_camera.Project(a.T_color_depth * p_depth) -
              b.color_camera.Project(b.T_color_depth * p_depth))
                 .norm();
      ++count;
    }
  }
  return sum / count * 640 / a.color_camera.width;
}

}  // namespace curvefusion
