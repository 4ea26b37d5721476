#include "fusion/curve_graph/mesh_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <set>

#include "capture/frame_stream.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Chosen while looking at training scans mixture 5 and chair 5 (docs/lab_notebook.md).
constexpr int kMaxViews = 40;
constexpr double kVoxel = 0.0015;  // metres: half of a thin wire's diameter
constexpr int kBand = 7;           // voxels before and behind what depth shows
constexpr int kPeakRange = 4;      // voxels before and behind a place, of which it is the best
constexpr int kDepthStride = 2;    // pixels
constexpr double kReach = 0.0045;  // metres beyond a wire's radius, into the gap
constexpr double kHidingDistance = 0.02;  // metres; what is so much nearer hides a place
constexpr double kFlat = 0.05;      // of the posterior: less change around a pixel tells little
constexpr double kMinScore = 0.9;   // 1.5 to 2 on a wire that stands alone, 0 anywhere
constexpr size_t kFirstStride = 4;  // of the images of a first look
constexpr double kFirstScore = 0.5;
constexpr int kMinLooks = 8;                      // images
constexpr double kNearest = 0.05;                 // metres before a camera
constexpr int64_t kMaxVoxels = int64_t{1} << 31;  // 256 MB, one bit each

struct View {
  RigidTransform T_depth_world, T_color_world;
  DepthImage depth;
  Image<float> excess;     // how much more than around it a pixel is like wire
  Image<float> amplitude;  // the mean of its absolute around the pixel
};

Image<float> BoxMean(const Image<float>& image, int side) {
  Image<float> mean(image.width(), image.height());
  const cv::Mat from(image.height(), image.width(), CV_32F, const_cast<float*>(image.data()));
  cv::Mat to(image.height(), image.width(), CV_32F, mean.data());
  cv::boxFilter(from, to, CV_32F, cv::Size(side, side), cv::Point(-1, -1), true,
                cv::BORDER_REPLICATE);
  return mean;
}

void SetExcess(const PosteriorImage& posterior, int side, View& view) {
  Image<float> value(posterior.width(), posterior.height());
  std::transform(posterior.data(), posterior.data() + posterior.size(), value.data(),
                 [](uint8_t p) { return static_cast<float>(p) / 255; });
  view.excess = BoxMean(value, side);
  for (size_t i = 0; i < value.size(); ++i) {
    float& excess = view.excess.data()[i];
    excess = value.data()[i] - excess;
    value.data()[i] = std::abs(excess);
  }
  view.amplitude = BoxMean(value, side);
}

class MeshSearch {
 public:
  MeshSearch(const Sequence& sequence, const std::vector<int>& frames,
             const std::vector<PosteriorImage>& posteriors, const Eigen::AlignedBox3d& bounds,
             double radius)
      : depth_camera_(sequence.depth_camera),
        color_camera_(sequence.color_camera),
        bounds_(bounds) {
    std::vector<const PosteriorImage*> of_view;
    const auto add_view = [&](const DecodedFrame& frame) {
      const RigidTransform T_depth_world = sequence.frames[frame.index].T_world_camera.inverse();
      views_.push_back(
          {T_depth_world, sequence.T_color_depth * T_depth_world, frame.depth, {}, {}});
      const auto at = std::lower_bound(frames.begin(), frames.end(), frame.index) - frames.begin();
      of_view.push_back(&posteriors[at]);
    };
    ForEachFrame(sequence, EvenlyThinned(frames, kMaxViews), {.depth = true, .color = false},
                 add_view);
    ParallelFor(0, static_cast<int64_t>(views_.size()), 1, [&](int64_t i) {
      const double z = std::max(kNearest, (views_[i].T_color_world * bounds_.center()).z());
      const double reach_px = (radius + kReach) * color_camera_.fx / z;
      SetExcess(*of_view[i], 2 * std::max(2, static_cast<int>(std::lround(reach_px))) + 1,
                views_[i]);
    });
    for (const View& view : views_) {
      middle_ += view.T_depth_world.inverse().translation() / static_cast<double>(views_.size());
    }
  }

  ObservedPoints Find() const {
    const std::vector<Vec3> around = AroundSurfaces();
    std::vector<std::optional<Vec3>> places(around.size());
    std::vector<int> looks(around.size());
    ParallelFor(0, static_cast<int64_t>(around.size()), 256, [&](int64_t i) {
      if (ScoreAt(around[i], kFirstStride).value < kFirstScore) return;
      const Score score = ScoreAt(around[i]);
      looks[i] = score.looks;
      if (score.looks >= kMinLooks && score.value >= kMinScore) places[i] = PeakNear(around[i]);
    });
    ObservedPoints points;
    std::set<std::array<int, 3>> taken;  // several voxels have the same peak
    for (size_t i = 0; i < around.size(); ++i) {
      if (!places[i]) continue;
      const Eigen::Array3i cell = CellOf(*places[i], 0.7 * kVoxel);
      if (!taken.insert({cell[0], cell[1], cell[2]}).second) continue;
      points.Add(*places[i], RayTo(*places[i]), static_cast<float>(looks[i]));
    }
    return points;
  }

 private:
  struct Score {
    double value = 0;
    int looks = 0;
  };

  // From the middle of all cameras.
  Vec3 RayTo(const Vec3& p) const { return (p - middle_).normalized(); }

  Eigen::Array3i CellOf(const Vec3& p, double side) const {
    return ((p - bounds_.min()).array() / side).floor().cast<int>();
  }

  // The middles of the voxels before and behind what depth shows.
  std::vector<Vec3> AroundSurfaces() const {
    const Eigen::Array3i count = (bounds_.sizes().array() / kVoxel).ceil().cast<int>();
    const int64_t all = int64_t{1} * count[0] * count[1] * count[2];
    if (all > kMaxVoxels) return {};
    std::vector<bool> is_near(all);
    for (const View& view : views_) {
      const RigidTransform T_world_depth = view.T_depth_world.inverse();
      for (int v = 0; v < view.depth.height(); v += kDepthStride) {
        for (int u = 0; u < view.depth.width(); u += kDepthStride) {
          if (view.depth(u, v) <= 0) continue;
          const Vec3 p = T_world_depth * depth_camera_.Unproject(u, v, view.depth(u, v));
          if (!bounds_.contains(p)) continue;
          const Vec3 step = kVoxel * (p - T_world_depth.translation()).normalized();
          for (int k = -kBand; k <= kBand; ++k) {
            const Eigen::Array3i cell = CellOf(p + k * step, kVoxel);
            if ((cell < 0).any() || (cell >= count).any()) continue;
            is_near[(int64_t{1} * cell[2] * count[1] + cell[1]) * count[0] + cell[0]] = true;
          }
        }
      }
    }
    std::vector<Vec3> middles;
    int64_t i = 0;
    for (int z = 0; z < count[2]; ++z) {
      for (int y = 0; y < count[1]; ++y) {
        for (int x = 0; x < count[0]; ++x, ++i) {
          if (!is_near[i]) continue;
          middles.push_back(bounds_.min() + kVoxel * Vec3(x + 0.5, y + 0.5, z + 0.5));
        }
      }
    }
    return middles;
  }

  // How much more than around it the images show wire at a place, by how much they change there at
  // all: one that sees a mesh from its edge changes little and tells little.
  Score ScoreAt(const Vec3& p, size_t stride = 1) const {
    double excess = 0, amplitude = 0;
    int looks = 0;
    for (size_t i = 0; i < views_.size(); i += stride) {
      const View& view = views_[i];
      const Vec3 in_color = view.T_color_world * p, in_depth = view.T_depth_world * p;
      if (in_color.z() < kNearest || in_depth.z() < kNearest) continue;
      const Vec2 in_color_px = color_camera_.Project(in_color);
      const Vec2 in_depth_px = depth_camera_.Project(in_depth);
      if (!color_camera_.Contains(in_color_px) || !depth_camera_.Contains(in_depth_px)) continue;
      const Eigen::Vector2i at = PinholeCamera::Rounded(in_depth_px);
      const double z = view.depth(at.x(), at.y());
      if (z > 0 && z < in_depth.z() - kHidingDistance) continue;
      const Eigen::Vector2i pixel = PinholeCamera::Rounded(in_color_px);
      excess += view.excess(pixel.x(), pixel.y());
      amplitude += view.amplitude(pixel.x(), pixel.y()) + kFlat;
      ++looks;
    }
    return {amplitude > 0 ? excess / amplitude : 0, looks};
  }

  // The best place before or behind; nothing where there is none within range.
  std::optional<Vec3> PeakNear(const Vec3& p) const {
    const Vec3 step = 0.5 * kVoxel * RayTo(p);
    constexpr int kSteps = 2 * kPeakRange;
    std::array<double, 2 * kSteps + 1> values;
    for (int k = -kSteps; k <= kSteps; ++k) values[k + kSteps] = ScoreAt(p + k * step).value;
    const auto best = std::max_element(values.begin(), values.end()) - values.begin();
    if (best == 0 || best == 2 * kSteps) return std::nullopt;
    const double bend = values[best - 1] + values[best + 1] - 2 * values[best];
    const double off = bend < 0 ? 0.5 * (values[best - 1] - values[best + 1]) / bend : 0;
    return p + (static_cast<double>(best - kSteps) + off) * step;
  }

  PinholeCamera depth_camera_, color_camera_;
  Eigen::AlignedBox3d bounds_;
  std::vector<View> views_;
  Vec3 middle_ = Vec3::Zero();
};

}  // namespace

ObservedPoints FindMeshPlaces(const Sequence& sequence, const std::vector<int>& frames,
                              const std::vector<PosteriorImage>& posteriors,
                              const Eigen::AlignedBox3d& bounds, double radius) {
  if (!sequence.has_depth || bounds.isEmpty()) return {};
  return MeshSearch(sequence, frames, posteriors, bounds, radius).Find();
}

}  // namespace curvefusion
