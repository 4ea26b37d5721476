#include "fusion/curve_graph/colour_beside.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "capture/frame_stream.h"
#include "capture/image_mat.h"

namespace curvefusion {

namespace {

constexpr size_t kPlaceStride = 2;  // chosen: of places kPlaceStep apart
// Chosen: metres beyond the curve's radius, out of its blur and mostly before the next wire.
constexpr double kDistance[] = {0.004, 0.007, 0.010};
constexpr double kHidden = 0.02;  // metres behind a curve; chosen: less is beside it
constexpr double kBlurPx = 1.5;   // around a curve its own colour shows
constexpr double kBlur = 0.002;   // metres, likewise: at .7 m
constexpr size_t kMinLooks = 6;   // chosen: images of a point, for a median and how far from it
// Chosen, for the wall behind the real cable: grey levels between points, for noise and shading,
constexpr double kEven = 4;
constexpr double kAnotherColour = 20;  // and from the curve's own colour.
constexpr size_t kMinDirections = 4;   // chosen: with known points on half of them or more
constexpr double kAhead = 1e-3;        // metres, between which a direction is projected
constexpr double kFromItsEnd = 1e-3;   // pixels that kAhead covers, at most

// Chosen: lines on surfaces that are looked at like stretches of curves.
constexpr int kSurfaceImages = 8;          // chosen: some hundred lines
constexpr int kLinesAcross = 16;           // of an image
constexpr double kHalfLine = 0.016;        // metres
constexpr double kLineRadius = 0.003;      // metres, as of a wire
constexpr double kSurfaceReach = 0.025;    // metres to all sides, beyond what is beside the line
constexpr double kSurfaceFlatness = 0.02;  // of the distance; noise is less
constexpr int kMinReachPx = 4;             // of kSurfaceReach on far surfaces

using Colour = Eigen::Array3d;

// What images show at a point.
struct SeenColour {
  Colour median;
  double change = 0;  // mean distance from it, grey levels
};

template <typename Channels>  // of a colour
SeenColour Summary(const std::vector<Channels>& colours) {
  SeenColour seen;
  std::vector<std::decay_t<decltype(colours[0][0])>> values(colours.size());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  for (int channel = 0; channel < 3; ++channel) {
    std::transform(colours.begin(), colours.end(), values.begin(),
                   [&](const Channels& color) { return color[channel]; });
    std::nth_element(values.begin(), middle, values.end());
    seen.median[channel] = *middle;
    for (const double value : values) seen.change += std::abs(value - seen.median[channel]);
  }
  seen.change /= static_cast<double>(3 * colours.size());
  return seen;
}

// From the axis of the thickest curve to where its colour ends.
double ReachOf(const std::vector<CurvePlace>& places) {
  double radius = 0;
  for (const CurvePlace& place : places) radius = std::max(radius, place.radius);
  return radius + kBlur;
}

std::vector<Vec3> PositionsOf(const std::vector<CurvePlace>& places) {
  std::vector<Vec3> positions;
  for (const CurvePlace& place : places) positions.push_back(place.position);
  return positions;
}

// How a line is seen at one of its places.
struct LineInImage {
  Vec2 pixel;
  Vec2 along;         // unit
  double own_px = 0;  // to both sides its own colour shows

  double DistanceTo(const Vec2& other) const {
    const Vec2 off = other - pixel;
    return std::abs(along.x() * off.y() - along.y() * off.x());
  }
};

std::optional<LineInImage> SeenIn(const PinholeCamera& camera, const RigidTransform& T_camera_world,
                                  const CurvePlace& place) {
  const Vec3 p = T_camera_world * place.position;
  if (p.z() < PinholeCamera::kNearest) return std::nullopt;
  const Vec3 ahead = p + kAhead * (T_camera_world.linear() * place.tangent);
  const Vec2 pixel = camera.Project(p);
  const Vec2 along = camera.Project(ahead) - pixel;
  if (along.norm() < kFromItsEnd) return std::nullopt;
  return LineInImage{pixel, along.normalized(), place.radius * camera.fx / p.z() + kBlurPx};
}

// The points of a depth image around one on a smooth surface.
struct SurfacePatch {
  Vec3 middle, left, right, above, below;  // camera frame

  bool IsFlat() const {
    const double most = kSurfaceFlatness * middle.z();
    return (left + right - 2 * middle).norm() < most && (above + below - 2 * middle).norm() < most;
  }
};

std::optional<SurfacePatch> PatchAt(const DepthImage& depth, const PinholeCamera& camera, int u,
                                    int v) {
  const double z = depth(u, v);
  if (z <= 0) return std::nullopt;
  const int reach = std::max(kMinReachPx, static_cast<int>(kSurfaceReach * camera.fx / z));
  const bool is_inside =
      u >= reach && v >= reach && u + reach < depth.width() && v + reach < depth.height();
  if (!is_inside) return std::nullopt;
  const auto point = [&](int du, int dv) -> Vec3 {
    return camera.Unproject(u + du, v + dv, depth(u + du, v + dv));
  };
  const SurfacePatch patch{point(0, 0), point(-reach, 0), point(reach, 0), point(0, -reach),
                           point(0, reach)};
  for (const Vec3& p : {patch.left, patch.right, patch.above, patch.below})
    if (p.z() <= 0) return std::nullopt;
  if (!patch.IsFlat()) return std::nullopt;
  return patch;
}

std::vector<CurvePlace> LineAt(const Vec3& middle, const Vec3& tangent) {
  std::vector<CurvePlace> places;
  for (double at = -kHalfLine; at <= kHalfLine + ColourBeside::kPlaceStep / 2;
       at += ColourBeside::kPlaceStep)
    places.push_back({0, at, kLineRadius, middle + at * tangent, tangent});
  return places;
}

}  // namespace

OnCurves::OnCurves(const std::vector<CurvePlace>& places)
    : places_(places), reach_(ReachOf(places)), grid_(PositionsOf(places), reach_) {}

bool OnCurves::Contains(const Vec3& point) const {
  bool is_on_curve = false;
  grid_.ForEachWithin(point, reach_, [&](int i, const Vec3& on_curve) {
    is_on_curve |= (on_curve - point).norm() < places_[static_cast<size_t>(i)].radius + kBlur;
  });
  return is_on_curve;
}

ColourBeside::ColourBeside(const std::vector<CurvePlace>& places) {
  static_assert(std::size(kDistance) == kDistances);
  for (size_t i = 0; i < places.size(); i += kPlaceStride) {
    Place& place = places_.emplace_back();
    place.on_curve = places[i];
    const Vec3 a = places[i].tangent.unitOrthogonal(), b = places[i].tangent.cross(a);
    for (int k = 0; k < kDirections; ++k) {
      const double angle = 2 * std::numbers::pi * k / kDirections;
      const Vec3 direction = std::cos(angle) * a + std::sin(angle) * b;
      for (int d = 0; d < kDistances; ++d)
        place.beside[k][d].position =
            places[i].position + (places[i].radius + kDistance[d]) * direction;
    }
  }
}

void ColourBeside::LeaveOut(const OnCurves& curves) {
  for (Place& place : places_)
    for (auto& points : place.beside)
      for (Point& point : points) point.is_on_curve = curves.Contains(point.position);
}

// Whether most of a direction is left out.
bool ColourBeside::HasCurvesBeside() const {
  for (size_t k = 0; k < kDirections; ++k) {
    size_t left_out = 0;
    for (const Place& place : places_)
      for (const Point& point : place.beside[k]) left_out += point.is_on_curve;
    if (2 * left_out > kDistances * places_.size()) return true;
  }
  return false;
}

void ColourBeside::Look(const ColorImage& smoothed, const PinholeCamera& camera,
                        const RigidTransform& T_camera_world, const CurvesInFront& hide) {
  const auto look = [&](const Vec2& pixel, double depth, std::vector<Rgb>& colours) {
    const Eigen::Vector2i at = PinholeCamera::Rounded(pixel);
    if (!hide.AreNearer(at.x(), at.y(), depth - kHidden))
      colours.push_back(smoothed(at.x(), at.y()));
  };
  for (Place& place : places_) {
    const auto line = SeenIn(camera, T_camera_world, place.on_curve);
    if (!line) continue;
    const double depth = (T_camera_world * place.on_curve.position).z();
    if (camera.Contains(line->pixel)) look(line->pixel, depth, place.own);
    for (auto& points : place.beside) {
      for (Point& point : points) {
        if (point.is_on_curve) continue;
        const Vec2 pixel = camera.Project(Vec3(T_camera_world * point.position));
        if (!camera.Contains(pixel) || line->DistanceTo(pixel) < line->own_px) continue;
        look(pixel, depth, point.colours);
      }
    }
  }
}

// The change in a direction; nothing where too little of it is seen, or where something even lies
// there of another colour than the curve's own: whether it is near or far is not to be told.
std::optional<double> ColourBeside::ChangeIn(size_t direction, const Colour& own) const {
  std::vector<Colour> medians;
  double sum = 0;
  size_t count = 0;
  for (const Place& place : places_) {
    for (const Point& point : place.beside[direction]) {
      count += !point.is_on_curve;
      if (point.colours.size() < kMinLooks) continue;
      const SeenColour seen = Summary(point.colours);
      medians.push_back(seen.median);
      sum += seen.change;
    }
  }
  if (2 * medians.size() < count) return std::nullopt;
  const SeenColour all = Summary(medians);
  if (all.change < kEven && (all.median - own).abs().mean() > kAnotherColour) return std::nullopt;
  return sum / static_cast<double>(medians.size());
}

ColourChange ColourBeside::Change() const {
  std::vector<Colour> on_curve;
  for (const Place& place : places_) {
    if (place.own.size() >= kMinLooks) on_curve.push_back(Summary(place.own).median);
  }
  if (on_curve.empty() || HasCurvesBeside()) return {};
  const Colour own = Summary(on_curve).median;
  std::vector<double> changes;
  for (size_t k = 0; k < kDirections; ++k) {
    if (const auto change = ChangeIn(k, own)) changes.push_back(*change);
  }
  if (changes.size() < kMinDirections) return {};
  const auto [least, most] = std::minmax_element(changes.begin(), changes.end());
  return {*least, *most};
}

ColorImage Smoothed(const ColorImage& image) {
  ColorImage smoothed(image.width(), image.height());
  const cv::Mat from = MatOf(image);
  cv::Mat to = MatOf(smoothed);
  cv::blur(from, to, cv::Size(3, 3));
  return smoothed;
}

std::vector<std::vector<CurvePlace>> LinesOnSurfaces(const Sequence& sequence) {
  std::vector<std::vector<CurvePlace>> lines;
  if (!sequence.has_depth) return lines;
  const PinholeCamera& camera = sequence.depth_camera;
  const int step = std::max(1, camera.width / kLinesAcross);
  const auto add_lines = [&](const DecodedFrame& frame) {
    const RigidTransform& T_world_camera = sequence.frames[frame.index].T_world_camera;
    bool is_horizontal = false;
    for (int v = step / 2; v < camera.height; v += step) {
      for (int u = step / 2; u < camera.width; u += step) {
        const auto patch = PatchAt(frame.depth, camera, u, v);
        if (!patch) continue;
        is_horizontal = !is_horizontal;
        const Vec3 along = is_horizontal ? patch->right - patch->left : patch->below - patch->above;
        lines.push_back(
            LineAt(T_world_camera * patch->middle, T_world_camera.linear() * along.normalized()));
      }
    }
  };
  ForEachFrame(sequence, EvenlyThinned(AllFrames(sequence), kSurfaceImages),
               {.depth = true, .color = false}, add_lines);
  return lines;
}

}  // namespace curvefusion
