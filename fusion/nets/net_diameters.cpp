#include "fusion/nets/net_diameters.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Chosen. Pixels are those of the sheet.
constexpr int kParts = 2;        // of a pixel, from sample to sample
constexpr int kProfile = 20;     // samples to either side: 6 mm
constexpr int kPeakReach = 2;    // likewise, by which one image is displaced
constexpr size_t kStride = 3;    // pixels from place to place
constexpr double kMinClear = 8;  // times noise
constexpr size_t kMinWidths = 20;
// Sine of the angle between a sheet and the line of sight, as seen along the wire; chosen: what is
// seen at a slant is blurred by more.
constexpr double kMinSlant = 0.7;
// Derived: full width at half height of a pixel, which is looked up between four of them.
constexpr double kBlurPx = 1.35;

using Colour = Eigen::Vector3f;
using Profile = std::array<float, 2 * kProfile + 1>;

// False where the image does not show it.
bool ColourAt(const SheetLook& look, const Vec2& p, Colour& colour) {
  const int u = static_cast<int>(std::floor(p.x())), v = static_cast<int>(std::floor(p.y()));
  if (!look.Contains(u, v) || !look.Contains(u + 1, v + 1)) return false;
  colour.setZero();
  for (int k = 0; k < 4; ++k) {
    const auto& corner = look(u + k % 2, v + k / 2);
    if (!corner[3]) return false;
    const double x = k % 2 ? p.x() - u : u + 1 - p.x(), y = k / 2 ? p.y() - v : v + 1 - p.y();
    colour += static_cast<float>(x * y) * Colour(corner[0], corner[1], corner[2]);
  }
  return true;
}

// How far colours across a line are from that in its middle, negative.
bool LookAcross(const SheetLook& look, const Vec2& p, const Vec2& aside, Profile& profile) {
  Colour wire, there;
  if (!ColourAt(look, p, wire)) return false;
  for (int i = -kProfile; i <= kProfile; ++i) {
    if (!ColourAt(look, p + i * aside, there)) return false;
    profile[static_cast<size_t>(kProfile + i)] = -(there - wire).cwiseAbs().sum() / 3;
  }
  return true;
}

// Pixels from the peak to half of its height on one side; 0 where it is lower than that.
double HalfWidth(const Profile& profile, int peak, int side, double min_height) {
  const auto at = [&](int i) { return profile[static_cast<size_t>(i)]; };
  int bottom = peak;
  for (int i = peak; i >= 0 && i <= 2 * kProfile; i += side) {
    if (at(i) < at(bottom)) bottom = i;
    if (at(i) > at(bottom) + 0.5 * min_height) break;  // the next wire
  }
  if (at(peak) - at(bottom) < min_height) return 0;
  const float half = 0.5F * (at(peak) + at(bottom));
  int i = peak;
  while (at(i) > half) i += side;
  return (std::abs(i - peak) - (half - at(i)) / (at(i - side) - at(i))) / kParts;
}

double WidthOf(const Profile& profile, double min_height) {
  const auto middle = profile.begin() + kProfile;
  const auto peak = static_cast<int>(
      std::max_element(middle - kPeakReach, middle + kPeakReach + 1) - profile.begin());
  const double before = HalfWidth(profile, peak, -1, min_height);
  const double after = HalfWidth(profile, peak, 1, min_height);
  return before > 0 && after > 0 ? before + after : 0;
}

}  // namespace

double DiameterOfLine(const ImageLine& line, const NetSheet& sheet, double step,
                      const std::vector<SheetView>& views, const std::vector<SheetLook>& looks,
                      const PinholeCamera& camera, double noise) {
  std::vector<double> diameters;
  size_t too_thin = 0;  // for the images
  Profile profile;
  for (size_t i = kStride; i + kStride < line.size(); i += kStride) {
    const double angle = AngleAt(line, i);
    const Vec2 aside = Vec2(-std::sin(angle), std::cos(angle)) / kParts;
    const Vec3 place = sheet.At(step * line[i].x(), step * line[i].y());
    const Vec3 along = sheet.axes * Vec3(std::cos(angle), std::sin(angle), 0);
    for (size_t n = 0; n < looks.size(); ++n) {
      const Vec3 sight = place - views[n].T_camera_world.inverse().translation();
      const double slant = std::abs(sheet.axes.col(2).dot(sight)) / sight.cross(along).norm();
      if (slant < kMinSlant || !LookAcross(looks[n], line[i], aside, profile)) continue;
      const double width = step * slant * WidthOf(profile, kMinClear * noise);
      const double blur = kBlurPx * sight.norm() / camera.fx;
      if (width > blur) {
        diameters.push_back(std::sqrt(width * width - blur * blur));
      } else {
        too_thin += width > 0;
      }
    }
  }
  const bool is_told = diameters.size() >= std::max(kMinWidths, too_thin);
  return is_told ? Median(std::move(diameters)) : 0;
}

}  // namespace curvefusion
