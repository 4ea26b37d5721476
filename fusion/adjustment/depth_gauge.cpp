#include "fusion/adjustment/depth_gauge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "capture/depth_noise.h"
#include "capture/frame_stream.h"
#include "fusion/adjustment/strip_depth.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Chosen: of depth at a strip, what is this near to the curve is the wire's.
constexpr double kMaxReach = 60 * kMillimetre;  // of the depth noise that is believed
constexpr double kMinReach = 8 * kMillimetre;   // quantisation and start together
constexpr double kReachSigmas = 3;              // of the scatter of depth about the curves
constexpr double kMinSigma = 3 * kMillimetre;   // errors of neighbouring pixels are alike
constexpr double kSigmaFactor = 1.5;            // of the scatter, for a single measurement

// The depth at one strip, in terms of the curves.
struct AxisSighting {
  AxisDepthObservation axis;
  double error = 0;  // of the axis as the curves have it
  bool is_strip = true;
  Vec2 pixel;  // of the strip, or of the curve without one
  Vec2 normal;
  std::array<std::optional<double>, 2> beyond_px;  // the strip's edges, where it ends in depth
};

bool EndsOnBothSides(const std::array<std::optional<double>, 2>& edges_px) {
  return edges_px[0] && edges_px[1];
}

StripPlace PlaceInDepthImage(const SeenStrip& seen, double radius, const Vec3& p_camera,
                             const Sequence& sequence) {
  const double scale = sequence.depth_camera.fx / sequence.color_camera.fx;
  const bool is_strip = seen.strip.accepted;
  StripPlace place;
  place.normal = seen.sample.normal;
  place.pixel = sequence.depth_camera.Project(p_camera);
  if (is_strip) place.pixel += scale * seen.strip.offset_px * seen.sample.normal;
  const double width_px = is_strip ? seen.strip.width_px : seen.sample.WidthPx(radius);
  place.half_width_px = 0.5 * scale * width_px;
  place.depth = p_camera.z();
  return place;
}

std::vector<AxisSighting> MeasureFrame(const DepthImage& depth, int frame, const Sequence& sequence,
                                       const CurveVertices& curves, const CurvePoseState& state,
                                       const FrameStrips& strips, double axis_depth, double reach) {
  std::vector<AxisSighting> sightings;
  for (const SeenStrip& seen : strips) {
    const Vec3 p_camera = state.T_camera_world[frame] * state.positions[seen.vertex];
    if (p_camera.z() <= 0) continue;
    const StripPlace place = PlaceInDepthImage(seen, curves.radii[seen.vertex], p_camera, sequence);
    const StripDepth found = MeasureStripDepth(depth, place, reach);
    if (!found.measured || (!seen.strip.accepted && !EndsOnBothSides(found.edges_px))) continue;
    const double before_axis =
        axis_depth * curves.radii[seen.vertex] * p_camera.z() / p_camera.norm();
    const double axis = found.depth + before_axis;
    AxisSighting sighting{{frame, seen.vertex, axis, 0},
                          axis - p_camera.z(),
                          seen.strip.accepted,
                          place.pixel,
                          place.normal,
                          found.edges_px};
    for (std::optional<double>& px : sighting.beyond_px) {
      if (px) *px -= place.half_width_px;
    }
    sightings.push_back(sighting);
  }
  return sightings;
}

StripObservation CentreOf(const AxisSighting& sighting) {
  const double offset_px = 0.5 * (*sighting.beyond_px[1] - *sighting.beyond_px[0]);
  return {sighting.axis.frame, sighting.axis.vertex, sighting.pixel + offset_px * sighting.normal,
          sighting.normal};
}

double SigmaOf(const std::vector<AxisSighting>& sightings, double reach) {
  std::vector<double> errors;
  for (const AxisSighting& sighting : sightings) {
    if (sighting.is_strip && std::abs(sighting.error) <= reach) errors.push_back(sighting.error);
  }
  return RobustDeviation(std::move(errors));
}

double ScatterOf(const DepthGauge& gauge) {
  double squares = 0;
  for (const AxisDepthObservation& seen : gauge.depths) squares += seen.depth * seen.depth;
  if (squares == 0) return 0;
  const double noise = kNoisePerSquaredDepth * squares / static_cast<double>(gauge.depths.size());
  return gauge.sigma / noise;
}

ColorShift ShiftOfColors(const std::vector<AxisSighting>& sightings, const Sequence& sequence,
                         int frame_count) {
  std::vector<StripEdge> edges;
  for (const AxisSighting& sighting : sightings) {
    if (!sighting.is_strip) continue;
    for (const int side : {-1, 1}) {
      const std::optional<double>& beyond_px = sighting.beyond_px[side > 0];
      if (beyond_px) edges.push_back({sighting.axis.frame, side * sighting.normal, *beyond_px});
    }
  }
  ColorShift shift = EstimateColorShift(edges, frame_count);
  const double scale = sequence.color_camera.fx / sequence.depth_camera.fx;
  shift.shift_px *= scale;
  for (Vec2& of_frame : shift.of_frames_px) of_frame *= scale;
  for (Vec2& sigma : shift.frame_sigmas_px) sigma *= scale;
  return shift;
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
    if (sighting.is_strip) gauge.depths.push_back(sighting.axis);
    if (EndsOnBothSides(sighting.beyond_px)) gauge.centres.push_back(CentreOf(sighting));
  }
  gauge.scatter = ScatterOf(gauge);
  gauge.color_shift = ShiftOfColors(sightings, sequence, static_cast<int>(indices.size()));
  return gauge;
}

}  // namespace curvefusion
