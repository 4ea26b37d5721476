#include "fusion/nets/surface_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "fusion/nets/box_sums.h"
#include "fusion/nets/smooth_depth.h"
#include "fusion/tracking/view_alignment.h"
#include "kernel/bilinear.h"
#include "kernel/parallel.h"
#include "kernel/quantile.h"
#include "kernel/thinned.h"

namespace curvefusion {

namespace {

// Chosen.
constexpr size_t kViews = 8;     // images beside a frame
constexpr size_t kMinViews = 4;  // of them, to tell what changes from noise
// Of the distance: how far beside a frame they are taken. Chosen: nearer ones show the same part of
// the background through a gap of 5 mm, farther ones see other surfaces.
constexpr double kMinBaseline = 0.025;
constexpr double kMaxBaseline = 0.2;
// Of the colours at a place the rest is left out: a thin thing before a wall is seen in few images.
// Chosen: with two thirds more is taken for nets (docs/lab_notebook.md#nets-kept).
constexpr double kCountedShare = 0.5;
// Metres from the smoothed depth to those tried. Chosen: a Kinect's is some millimetres off, and 2
// mm are a third of a pixel at .6 m between images .1 m apart.
constexpr std::array<float, 6> kOffsets = {0, -0.004f, -0.002f, 0.002f, 0.004f, 0.006f};
// Chosen.
constexpr int kAgreeing = 4;          // pixels to either side over which a depth is looked for
constexpr int kRows = 8;              // for a thread at a time
constexpr int kTrackingWidth = 640;   // pixels of the grey images by which poses are aligned
constexpr double kMaxDeviation = 12;  // grey levels: images that differ more are of something else

using Colour = std::array<float, 3>;

TrackingOptions GreyOptions() {
  TrackingOptions options;
  options.max_depth = SmoothDepth::kMaxDepth;
  options.image_width = kTrackingWidth;
  return options;
}

TrackingFrame FrameOf(const Sequence& sequence, const DepthImage& depth, const ColorImage& color) {
  return MakeTrackingFrame(depth, color,
                           {sequence.depth_camera, sequence.color_camera, sequence.T_color_depth},
                           GreyOptions());
}

// 1 at the squares of a surface that another depth image shows something nearer than.
MaskImage HiddenSquares(const DepthImage& surface, const DepthImage& other,
                        const PinholeCamera& camera, const RigidTransform& T_other_surface) {
  MaskImage hidden(surface.width(), surface.height(), 0);
  const PinholeCamera small = camera.Scaled(1.0 / SmoothDepth::kSquare);
  const auto is_nearer = [&](const Eigen::Vector2i& pixel, double z) {
    for (int v = pixel.y() - 1; v <= pixel.y() + 1; ++v)
      for (int u = pixel.x() - 1; u <= pixel.x() + 1; ++u)
        if (other.Contains(u, v) && other(u, v) > 0 && other(u, v) < z - SurfaceViews::kNearer)
          return true;
    return false;
  };
  for (int v = 0; v < surface.height(); ++v) {
    for (int u = 0; u < surface.width(); ++u) {
      if (!(surface(u, v) > 0)) continue;
      const Vec3 p = T_other_surface * small.Unproject(u, v, surface(u, v));
      hidden(u, v) = !(p.z() > 0) || is_nearer(PinholeCamera::Rounded(small.Project(p)), p.z());
    }
  }
  return hidden;
}

// An image that may show what a frame shows.
class View {
 public:
  // `hidden`: HiddenSquares of the frame's surface, empty where none is.
  View(ColorImage color, MaskImage hidden, const PinholeCamera& camera,
       const RigidTransform& T_color_reference)
      : color_(std::move(color)),
        hidden_(std::move(hidden)),
        fx_(static_cast<float>(camera.fx)),
        fy_(static_cast<float>(camera.fy)),
        cx_(static_cast<float>(camera.cx)),
        cy_(static_cast<float>(camera.cy)),
        rotation_(T_color_reference.linear().cast<float>()),
        translation_(T_color_reference.translation().cast<float>()) {}

  // Whether something nearer hides a pixel of the frame's depth image.
  bool IsHidden(int u, int v) const {
    return hidden_.Contains(u / SmoothDepth::kSquare, v / SmoothDepth::kSquare) &&
           hidden_(u / SmoothDepth::kSquare, v / SmoothDepth::kSquare);
  }

  // The colour where a point of the frame is seen; false where it is not.
  bool Sample(const Vec3f& p, Colour& colour) const {
    const Vec3f q = rotation_ * p + translation_;
    if (!(q.z() > 0)) return false;
    const float u = fx_ * q.x() / q.z() + cx_, v = fy_ * q.y() / q.z() + cy_;
    if (!(u >= 0 && v >= 0 && u < static_cast<float>(color_.width() - 1) &&
          v < static_cast<float>(color_.height() - 1))) {
      return false;
    }
    const Vec3f shown = Bilinear(color_, u, v);
    for (int k = 0; k < 3; ++k) colour[k] = gain_[k] * shown[k];
    return true;
  }

  void SetGain(const Colour& gain) { gain_ = gain; }

 private:
  ColorImage color_;
  MaskImage hidden_;
  float fx_, fy_, cx_, cy_;
  Eigen::Matrix3f rotation_;
  Vec3f translation_;
  Colour gain_ = {1, 1, 1};
};

// What the images show at one place.
struct Agreement {
  float change = -1;
  Colour mean = {};
};

float Distance(const Colour& a, const Colour& b) {
  return (std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2])) / 3;
}

Colour MeanOf(const Colour* colours, size_t count) {
  Colour sum = {};
  for (size_t i = 0; i < count; ++i)
    for (size_t k = 0; k < 3; ++k) sum[k] += colours[i][k];
  for (float& value : sum) value /= static_cast<float>(count);
  return sum;
}

Colour MedianOf(const Colour* colours, size_t count) {
  Colour median;
  std::array<float, kViews + 1> values;
  for (size_t k = 0; k < 3; ++k) {
    for (size_t i = 0; i < count; ++i) values[i] = colours[i][k];
    const auto middle = values.begin() + static_cast<int64_t>(count / 2);
    std::nth_element(values.begin(), middle, values.begin() + static_cast<int64_t>(count));
    median[k] = *middle;
  }
  return median;
}

// Of a point at a pixel of the frame's depth image.
Agreement Agree(const std::vector<View>& views, int u, int v, const Vec3f& p) {
  std::array<Colour, kViews + 1> colours;
  size_t count = 0;
  for (const View& view : views)
    if (!view.IsHidden(u, v)) count += view.Sample(p, colours[count]);
  if (count < kMinViews + 1) return {};
  const Colour all = MedianOf(colours.data(), count);
  const auto counted = static_cast<size_t>(std::ceil(kCountedShare * static_cast<double>(count)));
  std::nth_element(
      colours.begin(), colours.begin() + static_cast<int64_t>(counted),
      colours.begin() + static_cast<int64_t>(count),
      [&](const Colour& a, const Colour& b) { return Distance(a, all) < Distance(b, all); });
  Agreement agreement{0, MeanOf(colours.data(), counted)};
  for (size_t i = 0; i < counted; ++i)
    agreement.change += Distance(colours[i], agreement.mean) / static_cast<float>(counted);
  return agreement;
}

// The frames before and after, as long as they are near enough, evenly thinned.
std::vector<int> FramesBeside(const Sequence& sequence, int frame, double distance) {
  const auto center = [&](int i) { return sequence.frames[i].T_world_camera.translation(); };
  std::vector<int> beside;
  for (const int step : {-1, 1}) {
    for (int i = frame + step; i >= 0 && i < sequence.frame_count(); i += step) {
      const double baseline = (center(i) - center(frame)).norm();
      if (baseline > kMaxBaseline * distance) break;
      if (baseline > kMinBaseline * distance) beside.push_back(i);
    }
  }
  return ThinnedTo(beside, kViews);
}

// By how much an image is brighter, channel by channel, where both show the same.
void MatchExposure(const SurfaceViews& surface, const View& reference, View& view) {
  Colour of_reference = {}, of_view = {};
  for (int v = 0; v < surface.depth.height(); v += 4) {
    for (int u = 0; u < surface.depth.width(); u += 4) {
      if (!(surface.depth(u, v) > 0)) continue;
      const Vec3f p = surface.camera.Unproject(u, v, surface.depth(u, v)).cast<float>();
      Colour a, b;
      if (!reference.Sample(p, a) || !view.Sample(p, b)) continue;
      for (size_t k = 0; k < 3; ++k) {
        of_reference[k] += a[k];
        of_view[k] += b[k];
      }
    }
  }
  Colour gain;
  for (size_t k = 0; k < 3; ++k) gain[k] = of_view[k] > 0 ? of_reference[k] / of_view[k] : 1;
  view.SetGain(gain);
}

// Images aligned to a frame; the first is its own.
std::vector<View> ViewsOf(const Sequence& sequence, int frame, const DepthImage& depth,
                          const DepthImage& squares, const SurfaceViews& surface) {
  ColorImage color = LoadColor(sequence, frame);
  const Keyframe keyframe =
      MakeKeyframe(FrameOf(sequence, depth, color), surface.T_world_camera, sequence.T_color_depth);
  const std::vector<int> beside = FramesBeside(sequence, frame, keyframe.median_depth);
  const RigidTransform moved =
      surface.T_world_camera * sequence.frames[frame].T_world_camera.inverse();
  std::vector<std::optional<View>> aligned(beside.size());
  ParallelFor(0, static_cast<int64_t>(beside.size()), 1, [&](int64_t i) {
    ColorImage other = LoadColor(sequence, beside[i]);
    const ViewAlignment alignment =
        AlignToKeyframe(keyframe, FrameOf(sequence, {}, other),
                        moved * sequence.frames[beside[i]].T_world_camera, sequence.T_color_depth);
    if (alignment.deviation > kMaxDeviation) return;
    const RigidTransform T_other_frame =
        alignment.T_world_camera.inverse() * surface.T_world_camera;
    aligned[i].emplace(std::move(other),
                       HiddenSquares(squares, SquareMedians(LoadDepth(sequence, beside[i])),
                                     sequence.depth_camera, T_other_frame),
                       sequence.color_camera, sequence.T_color_depth * T_other_frame);
  });
  std::vector<View> views;
  views.emplace_back(std::move(color), MaskImage(), sequence.color_camera, sequence.T_color_depth);
  for (std::optional<View>& view : aligned) {
    if (!view) continue;
    MatchExposure(surface, views.front(), *view);
    views.push_back(std::move(*view));
  }
  return views;
}

// Changes and mean colours at one depth.
struct Layer {
  Image<float> change;
  Image<Colour> mean;
};

Layer LayerAt(const SurfaceViews& surface, const std::vector<View>& views, int divisor,
              float offset) {
  const int width = surface.depth.width(), height = surface.depth.height();
  Layer layer{Image<float>(width, height, -1), Image<Colour>(width, height, Colour{})};
  ParallelFor(0, height, kRows, [&](int64_t row) {
    const int v = static_cast<int>(row);
    for (int u = 0; u < width; ++u) {
      const float z = surface.depth(u, v);
      if (!(z > 0)) continue;
      const Agreement agreement = Agree(views, u * divisor, v * divisor,
                                        surface.camera.Unproject(u, v, z + offset).cast<float>());
      layer.change(u, v) = agreement.change;
      layer.mean(u, v) = agreement.mean;
    }
  });
  return layer;
}

float SlopeAt(const Image<Colour>& mean, const Image<float>& change, int u, int v) {
  float squares = 0;
  for (const auto& [du, dv] : {std::pair{1, 0}, std::pair{0, 1}}) {
    const bool after = change.Contains(u + du, v + dv) && change(u + du, v + dv) >= 0;
    const bool before = change.Contains(u - du, v - dv) && change(u - du, v - dv) >= 0;
    if (!after && !before) continue;
    const Colour& a = after ? mean(u + du, v + dv) : mean(u, v);
    const Colour& b = before ? mean(u - du, v - dv) : mean(u, v);
    const float slope = Distance(a, b) / static_cast<float>(after + before);
    squares += slope * slope;
  }
  return std::sqrt(squares);
}

// Every pixel from the depth at which the images around it agree best; where pixels are left out,
// from the smoothed depth.
void ChooseDepths(const std::vector<View>& views, int divisor, SurfaceViews& surface) {
  const std::span tried = std::span(kOffsets).first(divisor == 1 ? kOffsets.size() : 1);
  const int width = surface.depth.width(), height = surface.depth.height();
  surface.change = Image<float>(width, height, -1);
  surface.slope = Image<float>(width, height, 0);
  Image<float> best(width, height, std::numeric_limits<float>::infinity());
  Image<float> offsets(width, height, 0);
  for (const float offset : tried) {
    const Layer layer = LayerAt(surface, views, divisor, offset);
    const BoxSums around(layer.change);
    const int reach = std::max(1, kAgreeing / divisor);
    ParallelFor(0, height, kRows, [&](int64_t row) {
      const int v = static_cast<int>(row);
      for (int u = 0; u < width; ++u) {
        if (layer.change(u, v) < 0) continue;
        const float mean = around.Mean(u, v, reach);
        if (mean >= best(u, v)) continue;
        best(u, v) = mean;
        offsets(u, v) = offset;
        surface.change(u, v) = layer.change(u, v);
        surface.slope(u, v) = SlopeAt(layer.mean, layer.change, u, v) / static_cast<float>(divisor);
      }
    });
  }
  for (size_t i = 0; i < offsets.size(); ++i) {
    if (surface.change.data()[i] >= 0)
      surface.depth.data()[i] += offsets.data()[i];
    else
      surface.depth.data()[i] = 0;
  }
}

float NoiseOf(const Image<float>& change) {
  std::vector<double> known;
  for (size_t i = 0; i < change.size(); ++i)
    if (change.data()[i] >= 0) known.push_back(change.data()[i]);
  return known.empty() ? 0 : static_cast<float>(Median(std::move(known)));
}

}  // namespace

SurfaceViews LookAtSurface(const Sequence& sequence, int frame,
                           const RigidTransform& T_world_camera, const SurfaceLook& look) {
  SurfaceViews surface;
  surface.T_world_camera = T_world_camera;
  const DepthImage depth = LoadDepth(sequence, frame);
  const SmoothDepth smooth(depth);
  surface.camera = EveryNth(sequence.depth_camera, look.divisor);
  surface.depth = DepthImage(surface.camera.width, surface.camera.height, 0);
  bool any = false;
  for (int v = 0; v < surface.depth.height(); ++v) {
    for (int u = 0; u < surface.depth.width(); ++u) {
      const float z = smooth.At(u * look.divisor, v * look.divisor);
      if (!(z > 0) ||
          (look.where && !look.where(T_world_camera * surface.camera.Unproject(u, v, z)))) {
        continue;
      }
      surface.depth(u, v) = z;
      any = true;
    }
  }
  if (!any) return surface;
  const std::vector<View> views = ViewsOf(sequence, frame, depth, smooth.squares(), surface);
  if (views.size() < kMinViews + 1) return surface;
  ChooseDepths(views, look.divisor, surface);
  surface.noise = NoiseOf(surface.change);
  return surface;
}

RigidTransform PoseAfter(const Sequence& sequence, int earlier,
                         const RigidTransform& T_world_earlier, int frame) {
  const RigidTransform guess = T_world_earlier * sequence.frames[earlier].T_world_camera.inverse() *
                               sequence.frames[frame].T_world_camera;
  const Keyframe keyframe =
      MakeKeyframe(FrameOf(sequence, LoadDepth(sequence, earlier), LoadColor(sequence, earlier)),
                   T_world_earlier, sequence.T_color_depth);
  const ViewAlignment alignment = AlignToKeyframe(
      keyframe, FrameOf(sequence, {}, LoadColor(sequence, frame)), guess, sequence.T_color_depth);
  return alignment.deviation > kMaxDeviation ? guess : alignment.T_world_camera;
}

}  // namespace curvefusion
