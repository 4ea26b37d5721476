#include "fusion/adjustment/depth_gauge.h"

#include <algorithm>
#include <cmath>

#include "capture/frame_stream.h"
#include "fusion/registration/axis_depth.h"
#include "kernel/parallel.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr double kMaxReach = 60 * kMillimetre;  // of the depth noise that is believed
constexpr double kMinReach = 8 * kMillimetre;   // quantisation and start together
constexpr double kReachSigmas = 3;
constexpr double kMinSigma = 3 * kMillimetre;  // errors of neighbouring pixels are alike
constexpr double kSigmaFactor = 1.5;

// The depth at one strip, in terms of the curves.
struct AxisSighting {
  AxisDepthObservation axis;
  double error = 0;  // of the axis as the curves have it
  bool outlined = false;
  Vec2 normal;
  double offset_px = 0;
};

StripPlace PlaceInDepthImage(const SeenStrip& seen, const Vec3& p_camera,
                             const Sequence& sequence) {
  const double scale = sequence.depth_camera.fx / sequence.color_camera.fx;
  StripPlace place;
  place.normal = seen.sample.normal;
  place.pixel =
      sequence.depth_camera.Project(p_camera) + scale * seen.strip.offset_px * seen.sample.normal;
  place.half_width_px = 0.5 * scale * seen.strip.width_px;
  place.clearance_px = scale * seen.sample.clearance_px;
  place.depth = p_camera.z();
  return place;
}

std::vector<AxisSighting> MeasureFrame(const DepthImage& depth, int frame, const Sequence& sequence,
                                       const CurveVertices& curves, const CurvePoseState& state,
                                       const FrameStrips& strips, double axis_depth, double reach) {
  std::vector<AxisSighting> sightings;
  for (const SeenStrip& seen : strips) {
    if (!seen.strip.accepted) continue;
    const Vec3 p_camera = state.T_camera_world[frame] * state.positions[seen.vertex];
    if (p_camera.z() <= 0) continue;
    const StripPlace place = PlaceInDepthImage(seen, p_camera, sequence);
    const StripDepth found = MeasureStripDepth(depth, place, reach);
    if (!found.measured) continue;
    const double before_axis =
        axis_depth * curves.radii[seen.vertex] * p_camera.z() / p_camera.norm();
    const double axis = found.depth + before_axis;
    sightings.push_back({{frame, seen.vertex, axis, 0},
                         axis - p_camera.z(),
                         found.outlined,
                         place.normal,
                         found.offset_px});
  }
  return sightings;
}

double SigmaOf(const std::vector<AxisSighting>& sightings, double reach) {
  std::vector<double> errors;
  for (const AxisSighting& sighting : sightings) {
    if (std::abs(sighting.error) <= reach) errors.push_back(sighting.error);
  }
  return RobustDeviation(std::move(errors));
}

Vec2 ColorShift(const std::vector<AxisSighting>& sightings, const Sequence& sequence,
                int& outlines) {
  std::vector<Vec2> normals;
  std::vector<double> offsets_px;
  for (const AxisSighting& sighting : sightings) {
    if (!sighting.outlined) continue;
    normals.push_back(sighting.normal);
    offsets_px.push_back(-sighting.offset_px);  // of the colour strip from the depth outline
  }
  outlines = static_cast<int>(normals.size());
  return EstimateColorShift(normals, offsets_px) * sequence.color_camera.fx /
         sequence.depth_camera.fx;
}

}  // namespace

DepthGauge MeasureDepthGauge(const Sequence& sequence, const std::vector<int>& indices,
                             const CurveVertices& curves, const CurvePoseState& state,
                             const std::vector<FrameStrips>& strips, double axis_depth) {
  std::vector<AxisSighting> sightings;
  int frame = 0;
  ForEachFrame(sequence, indices, {.depth = true, .color = false},
               [&](const DecodedFrame& decoded) {
                 const auto found = MeasureFrame(decoded.depth, frame, sequence, curves, state,
                                                 strips[frame], axis_depth, kMaxReach);
                 sightings.insert(sightings.end(), found.begin(), found.end());
                 ++frame;
               });
  DepthGauge gauge;
  const double spread = SigmaOf(sightings, kMaxReach);
  const double reach = std::clamp(kReachSigmas * spread, kMinReach, kMaxReach);
  std::erase_if(sightings, [reach](const AxisSighting& s) { return std::abs(s.error) > reach; });
  gauge.sigma = SigmaOf(sightings, reach);
  for (AxisSighting& sighting : sightings) {
    sighting.axis.sigma = std::max(kMinSigma, kSigmaFactor * gauge.sigma);
    gauge.depths.push_back(sighting.axis);
  }
  gauge.color_shift_px = ColorShift(sightings, sequence, gauge.outlines);
  return gauge;
}

}  // namespace curvefusion
