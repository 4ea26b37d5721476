#include "fusion/nets/sheet_views.h"

#include <algorithm>
#include <cmath>

#include "capture/frame_stream.h"
#include "fusion/nets/surface_views.h"
#include "kernel/bilinear.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Chosen.
constexpr int kViews = 40;
constexpr size_t kMinLooks = 5;     // of a pixel
constexpr double kMinCosine = 0.3;  // of the angle between a line of sight and the upright
constexpr int kRows = 8;            // for a thread at a time

using Colour = std::array<float, 3>;

// Sees places with one image.
class Eye {
 public:
  Eye(const Sequence& sequence, const SheetView& view)
      : view_(view),
        color_(sequence.color_camera),
        depth_(sequence.depth_camera),
        T_depth_world_(view.T_camera_world.cast<float>()),
        T_color_world_((sequence.T_color_depth * view.T_camera_world).cast<float>()) {}

  bool See(const Vec3f& p, std::array<uint8_t, 4>& colour) const {
    const Vec3f q = T_color_world_ * p;
    if (!(q.z() > static_cast<float>(PinholeCamera::kNearest))) return false;
    const auto u = static_cast<float>(color_.fx * q.x() / q.z() + color_.cx);
    const auto v = static_cast<float>(color_.fy * q.y() / q.z() + color_.cy);
    const bool is_inside = u >= 0 && v >= 0 && u < static_cast<float>(view_.color.width() - 1) &&
                           v < static_cast<float>(view_.color.height() - 1);
    if (!is_inside || IsBehindCurves(u, v, q.z()) || IsHidden(T_depth_world_ * p)) return false;
    const Vec3f shown = Bilinear(view_.color, u, v);
    for (int k = 0; k < 3; ++k) colour[k] = static_cast<uint8_t>(shown[k] + 0.5F);
    colour[3] = 1;
    return true;
  }

 private:
  bool IsBehindCurves(float u, float v, float depth) const {
    return view_.known.AreNearer(static_cast<int>(u + 0.5F), static_cast<int>(v + 0.5F),
                                 depth - view_.nearer);
  }

  bool IsHidden(const Vec3f& p) const {
    const Eigen::Vector2i at = PinholeCamera::Rounded(depth_.Project(p.cast<double>()));
    if (!view_.depth.Contains(at.x(), at.y())) return false;
    const float z = view_.depth(at.x(), at.y());
    return z > 0 && z < p.z() - static_cast<float>(SurfaceViews::kNearer);
  }

  const SheetView& view_;
  const PinholeCamera& color_;
  const PinholeCamera& depth_;
  Eigen::Isometry3f T_depth_world_, T_color_world_;
};

// By how much each image is darker than the mean of all, channel by channel, where it is known.
std::vector<Colour> GainsOf(const std::vector<SheetLook>& looks) {
  std::vector<Colour> gains(looks.size(), {1, 1, 1});
  Image<std::array<float, 4>> sums(looks[0].width(), looks[0].height(), {});
  for (const SheetLook& look : looks)
    for (size_t i = 0; i < look.size(); ++i)
      for (size_t k = 0; k < 4; ++k) sums.data()[i][k] += look.data()[i][k];
  for (size_t n = 0; n < looks.size(); ++n) {
    std::array<double, 3> all = {}, own = {};
    for (size_t i = 0; i < sums.size(); ++i) {
      if (!looks[n].data()[i][3]) continue;
      for (size_t k = 0; k < 3; ++k) {
        own[k] += looks[n].data()[i][k];
        all[k] += sums.data()[i][k] / sums.data()[i][3];
      }
    }
    for (size_t k = 0; k < 3; ++k)
      if (own[k] > 0) gains[n][k] = static_cast<float>(all[k] / own[k]);
  }
  return gains;
}

float MedianOf(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<int64_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::vector<SheetView> ViewsOfSheet(const Sequence& sequence, const SkeletonGraph& skeleton,
                                    const NetSheet& sheet) {
  const Vec3 middle = sheet.At(0.5 * sheet.Width(), 0.5 * sheet.Height());
  const auto cosine = [&](int frame) {
    const Vec3 sight = middle - sequence.frames[frame].T_world_camera.translation();
    return std::abs(sight.normalized().dot(sheet.axes.col(2)));
  };
  std::vector<int> frames;
  for (int i = 0; i < sequence.frame_count(); ++i)
    if (cosine(i) >= kMinCosine) frames.push_back(i);
  std::vector<SheetView> views;
  ForEachFrame(sequence, EvenlyThinned(frames, kViews), {}, [&](const DecodedFrame& frame) {
    const RigidTransform T_camera_world = sequence.frames[frame.index].T_world_camera.inverse();
    views.push_back({frame.color,
                     frame.depth,
                     T_camera_world,
                     {skeleton, sequence.color_camera, sequence.T_color_depth * T_camera_world},
                     SurfaceViews::kNearer / cosine(frame.index)});
  });
  return views;
}

SheetPixels::SheetPixels(const NetSheet& sheet, double step)
    : places(static_cast<int>(sheet.Width() / step) + 1,
             static_cast<int>(sheet.Height() / step) + 1),
      known(places.width(), places.height(), 0) {
  for (int v = 0; v < places.height(); ++v) {
    for (int u = 0; u < places.width(); ++u) {
      places(u, v) = sheet.At(step * u, step * v).cast<float>();
      known(u, v) = sheet.IsKnown(step * u, step * v);
    }
  }
}

std::vector<SheetLook> LookAt(const Sequence& sequence, const std::vector<SheetView>& views,
                              const SheetPixels& pixels, const Vec3& move) {
  std::vector<SheetLook> looks(views.size());
  ParallelFor(0, static_cast<int64_t>(views.size()), 1, [&](int64_t n) {
    const Eye eye(sequence, views[n]);
    looks[n] = SheetLook(pixels.known.width(), pixels.known.height(), {});
    for (size_t i = 0; i < pixels.known.size(); ++i)
      if (pixels.known.data()[i])
        eye.See(pixels.places.data()[i] + move.cast<float>(), looks[n].data()[i]);
  });
  return looks;
}

SheetColours ColoursOf(const std::vector<SheetLook>& looks, const MaskImage& known) {
  const int width = known.width(), height = known.height();
  SheetColours colours;
  for (Image<float>& median : colours.median) median = Image<float>(width, height, 0);
  colours.change = Image<float>(width, height, -1);
  if (looks.empty()) return colours;
  const std::vector<Colour> gains = GainsOf(looks);
  ParallelFor(0, height, kRows, [&](int64_t row) {
    const int v = static_cast<int>(row);
    std::vector<Colour> seen;
    std::vector<float> values;
    for (int u = 0; u < width; ++u) {
      seen.clear();
      for (size_t n = 0; n < looks.size(); ++n) {
        const auto& colour = looks[n](u, v);
        if (colour[3])
          seen.push_back(
              {gains[n][0] * colour[0], gains[n][1] * colour[1], gains[n][2] * colour[2]});
      }
      if (seen.size() < kMinLooks) continue;
      for (size_t k = 0; k < 3; ++k) {
        values.clear();
        for (const Colour& colour : seen) values.push_back(colour[k]);
        colours.median[k](u, v) = MedianOf(values);
      }
      values.clear();
      for (const Colour& colour : seen) {
        float off = 0;
        for (size_t k = 0; k < 3; ++k) off += std::abs(colour[k] - colours.median[k](u, v)) / 3;
        values.push_back(off);
      }
      colours.change(u, v) = MedianOf(values);
    }
  });
  return colours;
}

}  // namespace curvefusion
