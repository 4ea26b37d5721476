#include "fusion/best/world_scale.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include <vector>

namespace curvefusion {

namespace {

// Metres. Of the paper's objects, 4.5 to 5.8 mm thick, on which lengths were chosen.
constexpr double kUsualDiameter = 0.005;
constexpr double kUsualPixel = 0.0011;  // metres; derived: of a Kinect V1 at .6 m
constexpr double kShown = 0.5;          // of the length; chosen
constexpr double kWorthwhile = 2;       // chosen: wires half as thick come out well as they are

AffineTransform ScalingAbout(const Vec3& fixed, double scale) {
  return Eigen::Translation3d(fixed) * Eigen::Scaling(scale) * Eigen::Translation3d(-fixed);
}

void Scale(double scale, std::vector<double>& lengths) {
  for (double& length : lengths) length *= scale;
}

SkeletonGraph Scaled(const SkeletonGraph& skeleton, const AffineTransform& motion, double scale) {
  SkeletonGraph scaled = Transformed(skeleton, motion);
  for (const EdgeId id : scaled.Edges()) {
    const SkeletonEdge edge = scaled.edge(id);
    std::vector<double> radii = edge.radii;
    Scale(scale, radii);
    scaled.SetCurve(id, edge.points, std::move(radii), edge.observations);
  }
  return scaled;
}

void Scale(double scale, RadiusEstimate& radii) {
  radii.global_radius *= scale;
  radii.unmeasured_radius *= scale;
  for (EdgeRadius& edge : radii.edges) {
    edge.radius *= scale;
    edge.error *= scale;
    for (RadiusAt& at : edge.along) at = {at.arc_length * scale, at.radius * scale};
  }
  for (StripWidth& strip : radii.strips) {
    strip.arc_length *= scale;
    strip.diameter *= scale;
  }
}

void Scale(double scale, UnprovenLengths& lengths) {
  lengths.surface *= scale;
  lengths.thick *= scale;
  lengths.looked_past *= scale;
  lengths.unproven *= scale;
}

void Scale(const AffineTransform& motion, double scale, UncertainCurves& uncertain) {
  uncertain.graph = Scaled(uncertain.graph, motion, scale);
  Scale(scale, uncertain.lengths);
  for (RefutedStretch& stretch : uncertain.beside_kept) {
    stretch.middle = motion * stretch.middle;
    stretch.length *= scale;
  }
}

void Scale(double scale, CurveFunnel& curves) {
  curves.contracted *= scale;
  Scale(scale, curves.unproven);
  curves.looked_past *= scale;
  curves.curves *= scale;
}

void Scale(double scale, Trust& trust) {
  trust.length *= scale;
  trust.wire_length *= scale;
  trust.pose_shift *= scale;
  trust.max_pose_shift *= scale;
}

void MoveCameras(const AffineTransform& motion, Sequence& sequence) {
  for (SequenceFrame& frame : sequence.frames) {
    frame.T_world_camera.translation() = motion * Vec3(frame.T_world_camera.translation());
  }
}

// Metres, of the depth images in the middle of the points, the mean over all frames.
double PixelAt(const ObservedPoints& points, const Sequence& sequence) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : points.positions) middle += p / static_cast<double>(points.size());
  double distance = 0;
  for (const SequenceFrame& frame : sequence.frames) {
    distance += (frame.T_world_camera.translation() - middle).norm();
  }
  return distance / static_cast<double>(sequence.frames.size()) / sequence.depth_camera.fx;
}

}  // namespace

void ScaleAbout(const Vec3& fixed, double scale, Reconstruction& result) {
  const AffineTransform motion = ScalingAbout(fixed, scale);
  result.skeleton = Scaled(result.skeleton, motion, scale);
  Scale(motion, scale, result.uncertain);
  result.points = Transformed(result.points, motion);
  Scale(scale, result.radii);
  Scale(scale, result.funnel.curves);
  Scale(scale, result.trust);
  MoveCameras(motion, result.sequence);
}

std::optional<double> MagnificationFor(const Reconstruction& result) {
  const Trust& trust = result.trust;
  if (trust.from_colour || result.points.empty()) return std::nullopt;
  double magnification = kUsualPixel / PixelAt(result.points, result.sequence);
  if (!result.skeleton.empty()) {
    if (std::min(trust.depth_share, trust.measured_share) < kShown) return std::nullopt;
    magnification = std::min(magnification, 0.5 * kUsualDiameter / result.radii.global_radius);
  }
  return magnification < kWorthwhile ? std::nullopt : std::optional(magnification);
}

Sequence Magnified(Sequence sequence, double magnification) {
  MoveCameras(ScalingAbout(Vec3::Zero(), magnification), sequence);
  sequence.T_color_depth.translation() *= magnification;
  sequence.depth_scale /= magnification;
  return sequence;
}

Reconstruction Reduced(Reconstruction result, double magnification, const Sequence& given) {
  ScaleAbout(Vec3::Zero(), 1 / magnification, result);
  result.sequence.T_color_depth = given.T_color_depth;
  result.sequence.depth_scale = given.depth_scale;
  return result;
}

void ReducingObserver::OnPoints(const std::string& name, const ObservedPoints& points) {
  observer_.OnPoints(name, Transformed(points, ScalingAbout(Vec3::Zero(), 1 / magnification_)));
}

void ReducingObserver::OnGraph(const std::string& name, const SkeletonGraph& graph) {
  const double scale = 1 / magnification_;
  observer_.OnGraph(name, Scaled(graph, ScalingAbout(Vec3::Zero(), scale), scale));
}

}  // namespace curvefusion
