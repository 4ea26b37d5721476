#include "fusion/live/view_directions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace curvefusion {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kLeastFrames = 2;  // chosen: one alone may be a glimpse through something else
// Sine of the least angle between a view and the tangent: below, a curve is a dot in the image.
constexpr double kLeastAcross = 0.34;  // chosen: 20 degrees
// A view beside the outermost ones: chosen, far enough to show another side, near enough to keep
// most of what was in view.
constexpr double kNextView = kPi / 4;
// Of the outermost views, whose frames tell which side was seen less. Chosen: more than a bin.
constexpr double kSide = kPi / 6;

struct Angle {
  double angle = 0;
  int frames = 0;
};

// Two directions square to a third of unit length and to each other.
std::pair<Vec3, Vec3> AxesAcross(const Vec3& tangent) {
  const Vec3 first = tangent.unitOrthogonal();
  return {first, tangent.cross(first)};
}

std::vector<Angle> AnglesAround(const ViewDirections& views, const Vec3& tangent) {
  const auto [x, y] = AxesAcross(tangent);
  std::vector<Angle> angles;
  for (int bin = 0; bin < ViewDirections::kBins; ++bin) {
    if (views.count(bin) < kLeastFrames) continue;
    const Vec3 direction = ViewDirections::Direction(bin);
    const Vec2 across(direction.dot(x), direction.dot(y));
    if (across.norm() < kLeastAcross) continue;
    angles.push_back({std::atan2(across.y(), across.x()), views.count(bin)});
  }
  std::sort(angles.begin(), angles.end(),
            [](const Angle& a, const Angle& b) { return a.angle < b.angle; });
  return angles;
}

// Where the longest stretch without views begins, by its index, and how long it is.
std::pair<size_t, double> LargestGap(const std::vector<Angle>& angles) {
  std::pair<size_t, double> largest{0, 0};
  for (size_t i = 0; i < angles.size(); ++i) {
    const bool last = i + 1 == angles.size();
    const double next = last ? angles.front().angle + 2 * kPi : angles[i + 1].angle;
    if (next - angles[i].angle > largest.second) largest = {i, next - angles[i].angle};
  }
  return largest;
}

int FramesNear(const std::vector<Angle>& angles, double angle) {
  int frames = 0;
  for (const Angle& other : angles) {
    if (std::abs(std::remainder(other.angle - angle, 2 * kPi)) < kSide) frames += other.frames;
  }
  return frames;
}

}  // namespace

void ViewDirections::Add(const Vec3& towards_camera) {
  int axis = 0;
  const double largest = towards_camera.cwiseAbs().maxCoeff(&axis);
  if (!(largest > 0)) return;
  const auto cell = [&](int other) {
    // Equal angles, not equal lengths, on the face.
    const double share = std::atan(towards_camera[other] / largest) / (kPi / 2) + 0.5;
    return std::clamp(static_cast<int>(share * kFaceSide), 0, kFaceSide - 1);
  };
  const int face = 2 * axis + (towards_camera[axis] < 0 ? 1 : 0);
  uint16_t& count = counts_[(face * kFaceSide + cell((axis + 1) % 3)) * kFaceSide +  //
                            cell((axis + 2) % 3)];
  if (count < std::numeric_limits<uint16_t>::max()) ++count;
}

ViewDirections& ViewDirections::operator+=(const ViewDirections& other) {
  constexpr int kMost = std::numeric_limits<uint16_t>::max();
  for (int bin = 0; bin < kBins; ++bin) {
    counts_[bin] = static_cast<uint16_t>(std::min(kMost, counts_[bin] + other.counts_[bin]));
  }
  return *this;
}

Vec3 ViewDirections::Direction(int bin) {
  const int face = bin / (kFaceSide * kFaceSide);
  const int axis = face / 2;
  const auto along = [](int cell) { return std::tan(((cell + 0.5) / kFaceSide - 0.5) * kPi / 2); };
  Vec3 direction;
  direction[axis] = face % 2 == 0 ? 1 : -1;
  direction[(axis + 1) % 3] = along(bin / kFaceSide % kFaceSide);
  direction[(axis + 2) % 3] = along(bin % kFaceSide);
  return direction.normalized();
}

ViewArc ArcAround(const ViewDirections& views, const Vec3& tangent) {
  const std::vector<Angle> angles = AnglesAround(views, tangent);
  if (angles.empty()) return {};
  const auto [before, gap] = LargestGap(angles);
  const double end = angles[before].angle;
  const double begin = angles[(before + 1) % angles.size()].angle;
  const double step = std::min(kNextView, gap / 2);
  const bool at_end = FramesNear(angles, end) <= FramesNear(angles, begin);
  const double next = at_end ? end + step : begin - step;
  const auto [x, y] = AxesAcross(tangent);
  return {2 * kPi - gap, std::cos(next) * x + std::sin(next) * y};
}

}  // namespace curvefusion
