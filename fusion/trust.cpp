#include "fusion/trust.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "fusion/reconstruction.h"
#include "kernel/polyline.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Metres along a curve for which a strip speaks: half of RadiusOptions::sample_step to both sides,
// and as much for the samples that other wires hide.
constexpr double kStripReach = 0.015;

// Of the length. Chosen: results of 18 scans of wires have .63 and more, what is left of two rooms
// .32 and .57 (docs/lab_notebook.md).
constexpr double kMinWireShare = 0.55;
// Of the length of curves from colour alone that lies near a strip. Chosen: a wire cube has .67, a
// table's legs of which nothing came out right .05 (docs/lab_notebook.md).
constexpr double kMinColourShare = 0.2;

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

}  // namespace

Trust MeasureTrust(const Sequence& given, const Reconstruction& result) {
  Trust trust = result.trust;
  MeasureShares(result, trust);
  trust.wire_length = std::min(trust.wire_length, trust.length);  // curves were cut since
  MeasurePoses(given, result.sequence, trust);
  return trust;
}

std::vector<std::string> Doubts(const Trust& trust) {
  std::vector<std::string> doubts;
  if (trust.length > 0 && trust.wire_length < kMinWireShare * trust.length) {
    doubts.push_back(fmt::format(
        "do not trust this result: by what the images show, only about {:.0f} % of its length is "
        "wire. Scan the object from nearer and from more sides ({:.2f} m of curve, a diameter was "
        "measured on {:.0f} %)",
        100 * trust.wire_length / trust.length, trust.length, 100 * trust.measured_share));
  }
  if (trust.length > 0 && trust.from_colour && trust.colour_share < kMinColourShare) {
    doubts.push_back(fmt::format(
        "do not trust this result: its curves come from the colour images alone, and these show a "
        "strip along {:.0f} % of them only. Scan from more sides, in more light",
        100 * trust.colour_share));
  }
  return doubts;
}

std::string PlacesWarning(const Trust& trust) {
  if (!trust.is_judged() || trust.adjusted) return {};
  return fmt::format(
      "the colour images could not confirm where the curves lie (a strip was seen along {:.0f} % "
      "of them): places are as exact as depth and camera poses, some millimetres. Poses were "
      "corrected by {:.0f} mm; if that is more than a few, scan again, slower (or, where the scan "
      "came with poses, try --track)",
      100 * trust.colour_share, 1000 * trust.pose_shift);
}

}  // namespace curvefusion
