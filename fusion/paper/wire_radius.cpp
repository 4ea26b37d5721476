#include "fusion/paper/wire_radius.h"

#include "fusion/strips/strip_box.h"
#include "fusion/strips/strip_samples.h"
#include "fusion/strips/strip_widths.h"
#include "graph/set_radius.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

std::vector<double> DiametersInImage(const ColorImage& image,
                                     const std::vector<CurveSample>& samples,
                                     const PinholeCamera& camera,
                                     const RigidTransform& T_camera_world, int box_size_px) {
  const StripRegions regions = LabelStrips(image, box_size_px);
  std::vector<double> diameters;
  for (const CurveSample& sample : samples) {
    const Vec3 p_camera = T_camera_world * sample.position;
    if (p_camera.z() <= 0) continue;
    const Vec2 pixel = camera.Project(p_camera);
    if (!camera.Contains(pixel)) continue;
    const double width_px = StripWidthInBox(regions, pixel, box_size_px);
    if (width_px > 0) diameters.push_back(width_px * p_camera.z() / camera.fx);
  }
  return diameters;
}

}  // namespace

void VisitOptions(WireRadiusOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"sample_step", "m", 0.0005, 0.1,
                 "Distance along the curves of the places where widths are measured. CurveFusion "
                 "4.3 gives no number."},
                options.sample_step);
  visitor.Visit({"box_size_px", "px", 4, 128,
                 "Side of the box that must hold exactly one strip. CurveFusion 4.3."},
                options.box_size_px);
  visitor.Visit({"histogram_bin", "m", 0.00001, 0.01,
                 "Bin of the histogram of diameters. CurveFusion 4.3 gives no number."},
                options.histogram_bin);
}

std::vector<double> MeasureDiameters(const SkeletonGraph& bundle_skeleton, const Sequence& sequence,
                                     const BundleFrames& frames, const WireRadiusOptions& options) {
  const auto [first, last] = frames;
  const std::vector<CurveSample> samples = SampleStrips(bundle_skeleton, options.sample_step);
  std::vector<std::vector<double>> of_frame(last - first);
  ParallelFor(0, last - first, 1, [&](int64_t i) {
    const int frame = first + static_cast<int>(i);
    of_frame[i] = DiametersInImage(LoadColor(sequence, frame), samples, sequence.color_camera,
                                   sequence.T_color_world(frame), options.box_size_px);
  });
  std::vector<double> diameters;
  for (const std::vector<double>& frame : of_frame) {
    diameters.insert(diameters.end(), frame.begin(), frame.end());
  }
  return diameters;
}

double AssignProminentRadius(const std::vector<double>& diameters, const WireRadiusOptions& options,
                             SkeletonGraph& skeleton) {
  const double radius = 0.5 * MostProminent(diameters, options.histogram_bin);
  if (radius <= 0) return 0;
  SetRadius(radius, skeleton);
  return radius;
}

}  // namespace curvefusion
