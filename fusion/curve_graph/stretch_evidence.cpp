#include "fusion/curve_graph/stretch_evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "capture/frame_stream.h"
#include "fusion/curve_graph/depth_profile.h"
#include "kernel/parallel.h"
#include "kernel/polyline.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Chosen where nothing else is said. The coefficients of wire_proof.cpp are fitted to what comes of
// these.
constexpr double kStretch = 0.04;    // metres; chosen: some diameters of wires, and their blur
constexpr double kMapStep = 0.0005;  // metres; derived: below a pixel from .3 m on
constexpr int kDirections = 36;      // steps of 10 degrees
constexpr int kColourImages = 30;    // chosen: a second of the parallax of 60 adds little
constexpr size_t kMinLines = 10;     // on surfaces, for a median
constexpr double kMinLooked = 0.3;   // share of a stretch that an image must show
constexpr double kEnoughImages = 3;  // from one direction: more of them tell the same
constexpr double kAgreement = 0.25;  // strips this near to the edge's diameter count
// Metres; derived: half of RadiusOptions::sample_step, and a little.
constexpr double kStripReach = 0.006;

// What images showed from one direction.
struct DirectionCounts {
  double images = 0, seen = 0, past = 0;
  double profiles = 0, open = 0, same = 0;
};

struct Stretch {
  EdgeId edge = 0;
  EdgePart part;
  double begin = 0, end = 0;  // arc lengths
  std::vector<CurvePlace> places;
  std::optional<ColourBeside> colours;  // as soon as the places are known
  Vec3 tangent, across;                 // unit
  std::array<DirectionCounts, kDirections> directions = {};
  std::vector<double> widths;
  double pixel = 0;
  int images = 0;
};

double RadiusAtPoint(const SkeletonEdge& edge, size_t i) {
  return edge.radii.empty() ? kUnknownRadius : edge.radii[i];
}

// Places along an edge between two arc lengths, half a step from both.
std::vector<CurvePlace> PlacesAlong(EdgeId id, const SkeletonEdge& edge,
                                    const std::vector<double>& arc, double begin, double end,
                                    double step) {
  const int count = std::max(1, static_cast<int>(std::lround((end - begin) / step)));
  std::vector<CurvePlace> places;
  size_t i = 0;
  for (int k = 0; k < count; ++k) {
    const double at = begin + (k + 0.5) * (end - begin) / count;
    while (i + 2 < arc.size() && arc[i + 1] < at) ++i;
    const Vec3 segment = edge.points[i + 1] - edge.points[i];
    const double share = std::clamp((at - arc[i]) / (arc[i + 1] - arc[i]), 0.0, 1.0);
    places.push_back(
        {id, at, RadiusAtPoint(edge, i), edge.points[i] + share * segment, segment.normalized()});
  }
  return places;
}

// The point nearest to an arc length, of those after `least`.
size_t PointNear(const std::vector<double>& arc, double at, size_t least) {
  size_t best = least;
  for (size_t i = least; i < arc.size(); ++i) {
    if (std::abs(arc[i] - at) < std::abs(arc[best] - at)) best = i;
  }
  return best;
}

std::vector<Stretch> StretchesOf(EdgeId id, const SkeletonEdge& edge) {
  const std::vector<double> arc = CumulativeLength(edge.points);
  const int count = std::max(1, static_cast<int>(std::lround(arc.back() / kStretch)));
  std::vector<Stretch> stretches;
  size_t first = 0;
  for (int k = 1; k <= count && first + 1 < arc.size(); ++k) {
    const size_t last =
        k == count ? arc.size() - 1 : PointNear(arc, arc.back() * k / count, first + 1);
    Stretch stretch{id, {first, last}, arc[first], arc[last]};
    stretch.places =
        PlacesAlong(id, edge, arc, stretch.begin, stretch.end, ColourBeside::kPlaceStep);
    const Vec3 chord = edge.points[last] - edge.points[first];
    stretch.tangent = chord.isZero() ? stretch.places.front().tangent : chord.normalized();
    stretch.across = stretch.tangent.unitOrthogonal();
    stretch.colours.emplace(stretch.places);
    stretches.push_back(std::move(stretch));
    first = last;
  }
  return stretches;
}

// From which direction around the curve a camera looks at it.
int DirectionOf(const Stretch& stretch, const Vec3& camera) {
  const Vec3 view = camera - stretch.places[stretch.places.size() / 2].position;
  const double angle =
      std::atan2(view.dot(stretch.tangent.cross(stretch.across)), view.dot(stretch.across));
  const double turn = angle / (2 * std::numbers::pi) + 0.5;
  return std::min(kDirections - 1, static_cast<int>(turn * kDirections));
}

void AddProfile(const DepthProfile& profile, DirectionCounts& counts, std::vector<double>& widths) {
  const auto is = [&](int side, Beside beside) { return profile.sides[side] == beside; };
  const int open = is(0, Beside::kOpen) + is(1, Beside::kOpen);
  const int same = is(0, Beside::kSame) + is(1, Beside::kSame);
  counts.profiles += 1;
  counts.same += same > 0;
  if (same == 0) counts.open += 0.5 * open;
  if (open == 2) widths.push_back(profile.width);
}

void LookAtStretch(const DecodedFrame& frame, const PinholeCamera& camera,
                   const RigidTransform& T_world_camera, const CurveMap& curves, Stretch& stretch) {
  const RigidTransform T_camera_world = T_world_camera.inverse();
  DirectionCounts counts;
  std::vector<double> widths;
  double looked = 0;
  for (const CurvePlace& place : stretch.places) {
    const DepthProfile profile = LookAcross(frame.depth, camera, T_camera_world, place, curves);
    if (profile.sight == Sight::kOutside || profile.sight == Sight::kHidden) continue;
    looked += 1;
    counts.seen += profile.sight == Sight::kSeen;
    counts.past += profile.sight == Sight::kPast;
    if (profile.sight == Sight::kSeen) AddProfile(profile, counts, widths);
  }
  if (looked == 0 || looked < kMinLooked * static_cast<double>(stretch.places.size())) return;
  DirectionCounts& all = stretch.directions[DirectionOf(stretch, T_world_camera.translation())];
  all.images += 1;
  all.seen += counts.seen / looked;
  all.past += counts.past / looked;
  all.profiles += counts.profiles / looked;
  all.open += counts.open / looked;
  all.same += counts.same / looked;
  stretch.widths.insert(stretch.widths.end(), widths.begin(), widths.end());
  stretch.pixel += (T_camera_world * stretch.places.front().position).z() / camera.fx;
  ++stretch.images;
}

StretchEvidence SummaryOf(const Stretch& stretch) {
  StretchEvidence evidence{stretch.edge, stretch.part, stretch.end - stretch.begin,
                           stretch.places[stretch.places.size() / 2].position, stretch.images};
  double weight = 0, profile_weight = 0;
  for (const DirectionCounts& counts : stretch.directions) {
    if (counts.images == 0) continue;
    ++evidence.directions;
    const double w = std::min(counts.images, kEnoughImages);
    weight += w;
    evidence.seen += w * counts.seen / counts.images;
    evidence.past += w * counts.past / counts.images;
    constexpr double kFewProfiles = 0.3;  // chosen: of the places of one image
    if (counts.profiles < kFewProfiles) continue;
    const double pw = w * std::min(1.0, counts.profiles / counts.images);
    profile_weight += pw;
    const double same = counts.same / counts.profiles, open = counts.open / counts.profiles;
    evidence.same += pw * same;
    evidence.open += pw * open;
    evidence.most_same = std::max(evidence.most_same, same);
    evidence.open_directions += open > 0.5;
  }
  if (weight > 0) {
    evidence.seen /= weight;
    evidence.past /= weight;
    evidence.pixel = stretch.pixel / stretch.images;
  }
  if (profile_weight > 0) {
    evidence.same /= profile_weight;
    evidence.open /= profile_weight;
  }
  if (!stretch.widths.empty()) evidence.width = Median(stretch.widths);
  return evidence;
}

void LookBeside(const Sequence& sequence, const SkeletonGraph& in_front,
                std::vector<Stretch>& stretches, std::vector<ColourBeside>& on_surfaces) {
  const PinholeCamera& camera = sequence.color_camera;
  const auto look = [&](const DecodedFrame& frame) {
    const ColorImage smoothed = Smoothed(frame.color);
    const RigidTransform T_color_world = sequence.T_color_world(frame.index);
    const CurvesInFront hide(in_front, camera, T_color_world);
    constexpr int64_t kGrain = 16;  // chosen: stretches of one task
    ParallelFor(0, static_cast<int64_t>(stretches.size()), kGrain, [&](int64_t i) {
      stretches[i].colours->Look(smoothed, camera, T_color_world, hide);
    });
    ParallelFor(0, static_cast<int64_t>(on_surfaces.size()), kGrain,
                [&](int64_t i) { on_surfaces[i].Look(smoothed, camera, T_color_world, hide); });
  };
  ForEachFrame(sequence, EvenlyThinned(AllFrames(sequence), kColourImages),
               {.depth = false, .color = true}, look);
}

// The median of the least change of those that are known; 0 where these are few.
double MedianOfLeast(const std::vector<ColourBeside>& lines) {
  std::vector<double> changes;
  for (const ColourBeside& line : lines) {
    const ColourChange change = line.Change();
    if (change.most > 0) changes.push_back(change.least);
  }
  return changes.size() < kMinLines ? 0 : Median(changes);
}

void AddStrips(const Stretch& stretch, const EdgeRadius& edge,
               const std::vector<double>& strip_places, StretchEvidence& evidence) {
  evidence.diameter = 2 * edge.radius;
  evidence.strips =
      static_cast<int>(std::count_if(strip_places.begin(), strip_places.end(), [&](double at) {
        return at >= stretch.begin && at < stretch.end;
      }));
  double covered = 0;
  for (const CurvePlace& place : stretch.places) {
    covered += std::any_of(strip_places.begin(), strip_places.end(), [&](double at) {
      return std::abs(at - place.arc_length) <= kStripReach;
    });
  }
  evidence.coverage = covered / static_cast<double>(stretch.places.size());
}

}  // namespace

std::vector<StretchEvidence> CollectEvidence(const SkeletonGraph& skeleton,
                                             const RadiusEstimate& radii, const Sequence& sequence,
                                             int max_frames, const SkeletonGraph& in_front) {
  std::vector<Stretch> stretches;
  std::vector<CurvePlace> curves;
  for (const EdgeId id : skeleton.Edges()) {
    const SkeletonEdge& edge = skeleton.edge(id);
    for (Stretch& stretch : StretchesOf(id, edge)) stretches.push_back(std::move(stretch));
    const std::vector<double> arc = CumulativeLength(edge.points);
    for (CurvePlace& place : PlacesAlong(id, edge, arc, 0, arc.back(), kMapStep)) {
      curves.push_back(std::move(place));
    }
  }
  if (stretches.empty()) return {};
  const OnCurves on_curves(curves);
  for (Stretch& stretch : stretches) stretch.colours->LeaveOut(on_curves);
  const std::vector<int> frames = EvenlyThinned(AllFrames(sequence), max_frames);
  ForEachFrame(sequence, frames, {.depth = true, .color = false}, [&](const DecodedFrame& frame) {
    const RigidTransform& T_world_camera = sequence.frames[frame.index].T_world_camera;
    const CurveMap map(curves, sequence.depth_camera, T_world_camera.inverse());
    constexpr int64_t kGrain = 16;  // chosen: stretches of one task
    ParallelFor(0, static_cast<int64_t>(stretches.size()), kGrain, [&](int64_t i) {
      LookAtStretch(frame, sequence.depth_camera, T_world_camera, map, stretches[i]);
    });
  });

  std::vector<ColourBeside> on_surfaces;
  for (const std::vector<CurvePlace>& line : LinesOnSurfaces(sequence))
    on_surfaces.emplace_back(line);
  LookBeside(sequence, in_front, stretches, on_surfaces);
  const double change_on_surfaces = MedianOfLeast(on_surfaces);

  std::map<EdgeId, EdgeRadius> radius_of;
  for (const EdgeRadius& edge : radii.edges) radius_of[edge.edge] = edge;
  std::map<EdgeId, std::vector<double>> strips_of;
  for (const StripWidth& strip : radii.strips) {
    const double diameter = 2 * radius_of[strip.edge].radius;
    if (diameter == 0 || std::abs(strip.diameter - diameter) <= kAgreement * diameter) {
      strips_of[strip.edge].push_back(strip.arc_length);
    }
  }
  std::vector<StretchEvidence> all;
  for (const Stretch& stretch : stretches) {
    all.push_back(SummaryOf(stretch));
    all.back().beside = stretch.colours->Change();
    all.back().on_surfaces = change_on_surfaces;
    AddStrips(stretch, radius_of[stretch.edge], strips_of[stretch.edge], all.back());
  }
  return all;
}

std::string EvidenceCsv(const SkeletonGraph& skeleton,
                        const std::vector<StretchEvidence>& evidence) {
  std::string text =
      "x0,y0,z0,x1,y1,z1,x2,y2,z2,edge,degree0,degree1,length,images,directions,seen,past,open,"
      "same,most_same,open_directions,width,pixel,strips,coverage,diameter,beside_least,"
      "beside_most,on_surfaces\n";
  for (const StretchEvidence& e : evidence) {
    const SkeletonEdge& edge = skeleton.edge(e.edge);
    for (const Vec3& p : {edge.points[e.part.first], e.middle, edge.points[e.part.last]}) {
      text += fmt::format("{:.5f},{:.5f},{:.5f},", p.x(), p.y(), p.z());
    }
    text += fmt::format(
        "{},{},{},{:.4f},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{},{:.5f},{:.6f},{},"
        "{:.4f},{:.5f},{:.2f},{:.2f},{:.2f}\n",
        e.edge, skeleton.Degree(edge.nodes[0]), skeleton.Degree(edge.nodes[1]), e.length, e.images,
        e.directions, e.seen, e.past, e.open, e.same, e.most_same, e.open_directions, e.width,
        e.pixel, e.strips, e.coverage, e.diameter, e.beside.least, e.beside.most, e.on_surfaces);
  }
  return text;
}

}  // namespace curvefusion
