#include "fusion/curve_graph/depth_profile.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "capture/depth_noise.h"

namespace curvefusion {

namespace {

// Chosen: poses registered to the curves leave them so far beside their images.
constexpr double kMaxShift = 0.003;  // metres
// Measured on simulated scans: drift along the viewing ray, and three standard deviations of
// Khoshelham's 1.425 mm z^2, at depth z in metres.
constexpr double kToleranceNear = 0.015;
constexpr double kToleranceFar = 0.0043;  // 1/m
// Metres; derived: what a surface at 60 degrees adds to the noise of a step between pixels.
constexpr double kStepNear = 0.005;
// Derived: beyond 63 degrees a surface is not told from the ramp that sensors lay between near and
// far things.
constexpr double kSteep = 2;
constexpr double kReach = 0.03;  // metres to a side: the widest wires, 12 mm, and their fattening
constexpr int kMaxGapPx = 4;     // without a measurement; the shadow beside a wire may be wider
// Chosen: of one edge, what is so many times farther along it than across is another curve.
constexpr double kAlongPerAcross = 3;

double DepthTolerance(double z) { return kToleranceNear + kToleranceFar * z * z; }
double DepthStep(double z) { return kStepNear + kStepPerSquaredDepth * z * z; }

// The line of pixels across a curve.
struct Line {
  const DepthImage& depth;
  Vec2 center;
  Vec2 normal;  // unit

  bool Contains(int k) const {
    const Eigen::Vector2i pixel = At(k);
    return depth.Contains(pixel.x(), pixel.y());
  }
  Eigen::Vector2i At(int k) const { return PinholeCamera::Rounded(center + k * normal); }
  double Depth(int k) const {
    const Eigen::Vector2i pixel = At(k);
    return depth(pixel.x(), pixel.y());
  }
};

std::optional<Line> LineAcross(const DepthImage& depth, const PinholeCamera& camera,
                               const Vec3& p_camera, const Vec3& tangent_camera) {
  const double z = p_camera.z();
  if (z < PinholeCamera::kNearest) return std::nullopt;
  const Vec2 center = camera.Project(p_camera);
  if (!camera.Contains(center)) return std::nullopt;
  Vec2 along(camera.fx * (tangent_camera.x() - tangent_camera.z() * p_camera.x() / z),
             camera.fy * (tangent_camera.y() - tangent_camera.z() * p_camera.y() / z));
  constexpr double kMinAcross = 0.4;  // chosen: seen nearly end on beyond it
  if (along.norm() < kMinAcross * camera.fx) return std::nullopt;
  along.normalize();
  return Line{depth, center, {-along.y(), along.x()}};
}

// Which pixel of the line agrees with the curve, the nearest to its place; otherwise why none does.
struct Hit {
  Sight sight = Sight::kNothing;
  int k = 0;
};

Hit FindCurve(const Line& line, double near_side, double reach_px) {
  const double tolerance = DepthTolerance(near_side);
  const int reach = static_cast<int>(std::ceil(reach_px));
  double farthest = 0;
  for (int i = 0; i <= 2 * reach; ++i) {
    const int k = i % 2 == 0 ? -i / 2 : (i + 1) / 2;
    if (!line.Contains(k)) continue;
    const double measured = line.Depth(k);
    if (!(measured > 0)) continue;
    if (std::abs(measured - near_side) <= tolerance) return {Sight::kSeen, k};
    farthest = std::max(farthest, measured);
  }
  if (farthest == 0) return {Sight::kNothing, 0};
  return {farthest < near_side ? Sight::kHidden : Sight::kPast, 0};
}

struct SideOf {
  Beside beside = Beside::kUnknown;
  int last = 0;  // pixel that is still connected
};

// Follows connected depth from the curve to one side.
SideOf FollowSide(const Line& line, int from, int direction, double metres_per_px,
                  const CurvePlace& place, const CurveMap& curves) {
  const double start = line.Depth(from);
  double previous = start;
  SideOf side{Beside::kUnknown, from};
  for (int k = from + direction, gap = 0;; k += direction) {
    const double distance = std::abs(k - from) * metres_per_px;
    if (distance > kReach) return {Beside::kSame, side.last};
    if (!line.Contains(k)) return side;
    const double measured = line.Depth(k);
    if (!(measured > 0)) {
      if (++gap > kMaxGapPx) return side;
      continue;
    }
    const double step = DepthStep(start) * (1 + gap);
    const bool is_steep = measured - start > std::max(DepthTolerance(start), kSteep * distance);
    if (measured > previous + step || is_steep) return {Beside::kOpen, side.last};
    if (measured < previous - step) return side;
    const Eigen::Vector2i pixel = line.At(k);
    if (curves.IsOther(pixel.x(), pixel.y(), place, distance)) return side;
    previous = measured;
    side.last = k;
    gap = 0;
  }
}

}  // namespace

CurveMap::CurveMap(const std::vector<CurvePlace>& places, const PinholeCamera& camera,
                   const RigidTransform& T_camera_world)
    : places_(places), nearest_(camera.width, camera.height, -1) {
  for (size_t i = 0; i < places.size(); ++i) {
    const Vec3 p_camera = T_camera_world * places[i].position;
    if (p_camera.z() <= 0) continue;
    const Vec2 pixel = camera.Project(p_camera);
    if (!camera.Contains(pixel)) continue;
    const Eigen::Vector2i at = PinholeCamera::Rounded(pixel);
    nearest_(at.x(), at.y()) = static_cast<int>(i);
  }
}

bool CurveMap::IsOther(int u, int v, const CurvePlace& place, double distance) const {
  const int index = nearest_(u, v);
  if (index < 0) return false;
  const CurvePlace& other = places_[index];
  // Metres; chosen: what is nearer than a wire is wide is the same wire.
  constexpr double kSameWire = 0.004;
  if (distance < kSameWire) return false;
  if (other.edge != place.edge) return true;
  return std::abs(other.arc_length - place.arc_length) > kAlongPerAcross * distance;
}

DepthProfile LookAcross(const DepthImage& depth, const PinholeCamera& camera,
                        const RigidTransform& T_camera_world, const CurvePlace& place,
                        const CurveMap& curves) {
  const Vec3 p_camera = T_camera_world * place.position;
  const std::optional<Line> line =
      LineAcross(depth, camera, p_camera, T_camera_world.linear() * place.tangent);
  if (!line) return {};
  const double metres_per_px = p_camera.z() / camera.fx;
  const double near_side = p_camera.z() - place.radius;
  const Hit hit =
      FindCurve(*line, near_side, kBesidePx + (kMaxShift + place.radius) / metres_per_px);
  DepthProfile profile;
  profile.sight = hit.sight;
  if (hit.sight != Sight::kSeen) return profile;
  const SideOf left = FollowSide(*line, hit.k, -1, metres_per_px, place, curves);
  const SideOf right = FollowSide(*line, hit.k, 1, metres_per_px, place, curves);
  profile.sides = {left.beside, right.beside};
  profile.width = (right.last - left.last + 1) * metres_per_px;
  return profile;
}

}  // namespace curvefusion
