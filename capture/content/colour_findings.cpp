#include "capture/content/colour_findings.h"

#include <fmt/format.h>

#include "capture/content/geometry_messages.h"

namespace curvefusion {

std::string DescribeColourCamera(const ColourCameraFit& fit) {
  const Vec3 offset = fit.T_color_depth.translation() / kMillimetre;
  return fmt::format(
      "colour lies {:.0f} px beside depth (mean of {} places on depth edges, {:.1f} m away in the "
      "median); fitted colour camera: f {:.1f} +- {:.1f}, centre ({:.1f} +- {:.1f}, {:.1f} +- "
      "{:.1f}), offset ({:.0f} +- {:.0f}, {:.0f} +- {:.0f}) mm; mean distance of depth edge to "
      "colour edge {:.1f} -> {:.1f} px",
      fit.displacement_px, fit.points, fit.median_depth, fit.color_camera.fx, fit.f_error,
      fit.color_camera.cx, fit.cx_error, fit.color_camera.cy, fit.cy_error, offset.x(),
      fit.tx_error / kMillimetre, offset.y(), fit.ty_error / kMillimetre, fit.given_px,
      fit.fitted_px);
}

std::string ColourCameraJson(const PinholeCamera& color_camera,
                             const RigidTransform& T_color_depth) {
  std::string rows;
  for (int row = 0; row < 4; ++row) {
    const Eigen::RowVector4d values = T_color_depth.matrix().row(row);
    rows += fmt::format("{}[{:.6g}, {:.6g}, {:.6g}, {:.6g}]", row == 0 ? "" : ", ", values[0],
                        values[1], values[2], values[3]);
  }
  return fmt::format(
      "\"color_camera\": {{\"width\": {}, \"height\": {}, \"fx\": {:.1f}, \"fy\": {:.1f}, "
      "\"cx\": {:.1f}, \"cy\": {:.1f}}}, \"T_color_depth\": [{}]",
      color_camera.width, color_camera.height, color_camera.fx, color_camera.fy, color_camera.cx,
      color_camera.cy, rows);
}

void ReportColourCamera(const Sequence& sequence, const ColourCameraFit& fit,
                        const FindingHandler& on_finding) {
  if (!fit.IsMisregistered()) return;
  on_finding(
      {Severity::kWarning,
       fmt::format("{}: {}; wires are looked for in the wrong place of the images and most "
                   "are lost; `reconstruct` uses the fitted camera unless told otherwise; "
                   "in {} write: {}",
                   sequence.folder.string(), DescribeColourCamera(fit), IntrinsicsFile(sequence),
                   ColourCameraJson(fit.color_camera, fit.T_color_depth)),
       "colour-misregistered"});
}

bool UseFittedColourCamera(Sequence& sequence) {
  if (!sequence.has_depth) return false;
  const ColourCameraFit fit = FitColourCamera(sequence, {});
  if (!fit.IsMisregistered()) return false;
  sequence.color_camera = fit.color_camera;
  sequence.T_color_depth = fit.T_color_depth;
  sequence.warnings.push_back(
      DescribeColourCamera(fit) +
      "; the fitted camera was used, `--colour-camera given` keeps the one of the intrinsics");
  return true;
}

}  // namespace curvefusion
