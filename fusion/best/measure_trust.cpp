#include "fusion/best/measure_trust.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "kernel/angle.h"
#include "kernel/polyline.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Metres along a curve, to both sides, for which a strip speaks. Derived: half of
// RadiusOptions::sample_step, and one step for the samples that other wires hide.
constexpr double kStripReach = 0.015;

using PlacesOfEdge = std::map<EdgeId, std::vector<double>>;

PlacesOfEdge StripPlaces(const RadiusEstimate& radii) {
  PlacesOfEdge places;
  for (const StripWidth& strip : radii.strips) places[strip.edge].push_back(strip.arc_length);
  for (auto& [edge, of_edge] : places) std::sort(of_edge.begin(), of_edge.end());
  return places;
}

bool IsNear(const std::vector<double>& places, double place) {
  const auto next = std::lower_bound(places.begin(), places.end(), place - kStripReach);
  return next != places.end() && *next <= place + kStripReach;
}

// The length of a curve whose segments' ends fulfil it, each end for half of the segment.
template <class Holds>
double LengthWhere(const Polyline& points, const Holds& holds) {
  double length = 0;
  for (size_t i = 1; i < points.size(); ++i) {
    const double half = 0.5 * (points[i] - points[i - 1]).norm();
    length += half * (static_cast<double>(holds(i - 1)) + static_cast<double>(holds(i)));
  }
  return length;
}

bool IsSeen(const ViewCount& views) { return views.seen > 0 && 2 * views.seen >= views.looked; }

void MeasureShares(const Reconstruction& result, Trust& trust) {
  std::map<EdgeId, bool> measured;
  for (const EdgeRadius& radius : result.radii.edges) measured[radius.edge] = radius.radius > 0;
  const PlacesOfEdge strips = StripPlaces(result.radii);
  double with_diameter = 0, with_depth = 0, with_colour = 0;
  for (const EdgeViews& views : result.views.edges) {
    const Polyline& points = result.skeleton.edge(views.edge).points;
    const std::vector<double> arc = CumulativeLength(points);
    const double length = Length(points);
    trust.length += length;
    if (measured[views.edge]) with_diameter += length;
    with_depth += LengthWhere(points, [&](size_t i) { return IsSeen(views.points[i]); });
    const auto of_edge = strips.find(views.edge);
    if (of_edge == strips.end()) continue;
    with_colour += LengthWhere(points, [&](size_t i) { return IsNear(of_edge->second, arc[i]); });
  }
  if (trust.length <= 0) return;
  trust.measured_share = with_diameter / trust.length;
  trust.depth_share = with_depth / trust.length;
  trust.colour_share = with_colour / trust.length;
}

void MeasurePoses(const Sequence& given, const Sequence& corrected, Trust& trust) {
  std::vector<double> shifts, turns;
  for (size_t i = 0; i < given.frames.size() && i < corrected.frames.size(); ++i) {
    const RigidTransform& a = given.frames[i].T_world_camera;
    const RigidTransform& b = corrected.frames[i].T_world_camera;
    shifts.push_back((b.translation() - a.translation()).norm());
    turns.push_back(Eigen::AngleAxisd(Mat3(a.linear().transpose() * b.linear())).angle());
  }
  if (shifts.empty()) return;
  trust.max_pose_shift = *std::max_element(shifts.begin(), shifts.end());
  trust.pose_shift = Median(std::move(shifts));
  trust.pose_turn = Median(std::move(turns));
}

// Along an arc, the direction that differs most from the first is one of the two.
double ViewAngle(const Sequence& sequence, const SkeletonGraph& skeleton) {
  const Vec3 middle = BoundsOf(skeleton).center();
  std::vector<Vec3> directions;
  for (const SequenceFrame& frame : sequence.frames) {
    directions.push_back((frame.T_world_camera.translation() - middle).normalized());
  }
  if (directions.empty()) return 0;
  const auto farthest = [&](const Vec3& from) {
    return *std::min_element(
        directions.begin(), directions.end(),
        [&](const Vec3& a, const Vec3& b) { return a.dot(from) < b.dot(from); });
  };
  const Vec3 first = farthest(directions.front());
  return AngleBetween(first, farthest(first));
}

}  // namespace

Trust MeasureTrust(const Sequence& given, const Reconstruction& result) {
  Trust trust = result.trust;
  MeasureShares(result, trust);
  trust.wire_length = std::min(trust.wire_length, trust.length);  // curves were cut since
  MeasurePoses(given, result.sequence, trust);
  if (trust.is_judged()) trust.view_angle = ViewAngle(result.sequence, result.skeleton);
  return trust;
}

}  // namespace curvefusion
