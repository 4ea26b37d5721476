#include "fusion/tracking/photometric_term.h"

#include <algorithm>
#include <cmath>

#include "kernel/parallel.h"
#include "kernel/quantile.h"
#include "kernel/thinned.h"

namespace curvefusion {

namespace {

constexpr int kPointsPerChunk = 1024;  // chosen, changes no result
constexpr size_t kMaxPoints = 6000;    // of a level. Chosen: 4 ms an iteration would be too long
constexpr float kMinGradient = 4;      // grey levels a pixel. Chosen: twice an image's noise
// Of the depth. Chosen: neighbours of one surface at 70 degrees.
constexpr float kDepthEdge = 0.04f;
// Grey levels. Chosen: an 8-bit camera's noise in an image reduced to a quarter of its pixels;
// simulated images of no noise at all must not outweigh depth.
constexpr double kMinDeviation = 2;
// Grey levels. Chosen: what differs between images of one place, interpolation and vignetting
// included. Weights do not follow the deviation found: a poor start would weaken the term.
constexpr double kGreyNoise = 3;

bool IsOnDepthEdge(const DepthImage& depth, int u, int v) {
  const float middle = depth(u, v);
  for (int y = v - 1; y <= v + 1; ++y) {
    for (int x = u - 1; x <= u + 1; ++x) {
      const float z = depth(x, y);
      if (z > 0 && std::abs(z - middle) > kDepthEdge * middle) return true;
    }
  }
  return false;
}

std::vector<GreyPoint> GreyPoints(const FrameLevel& level, const RigidTransform& T_color_depth) {
  std::vector<GreyPoint> points;
  const PinholeCamera& color = level.color_camera;
  for (int v = 1; v + 1 < level.depth.height(); ++v) {
    for (int u = 1; u + 1 < level.depth.width(); ++u) {
      const float z = level.depth(u, v);
      if (!(z > 0)) continue;
      const Vec3 p = level.depth_camera.Unproject(u, v, z);
      const Vec3 p_color = T_color_depth * p;
      if (p_color.z() <= 0) continue;
      const Vec2 pixel = color.Project(p_color);
      GreySample sample;
      if (!SampleGrey(level.grey, static_cast<float>(pixel.x()), static_cast<float>(pixel.y()),
                      sample) ||
          sample.du * sample.du + sample.dv * sample.dv < kMinGradient * kMinGradient ||
          IsOnDepthEdge(level.depth, u, v)) {
        continue;
      }
      points.push_back({p.cast<float>(), sample.value});
    }
  }
  return ThinnedTo(points, kMaxPoints);
}

double MedianDepth(const DepthImage& depth) {
  std::vector<double> depths;
  for (const float* z = depth.data(); z != depth.data() + depth.size(); ++z) {
    if (*z > 0) depths.push_back(*z);
  }
  return depths.empty() ? 0 : Median(std::move(depths));
}

double Contrast(const std::vector<GreyPoint>& points) {
  if (points.empty()) return 0;
  std::vector<double> greys;
  for (const GreyPoint& point : points) greys.push_back(point.grey);
  const double middle = Median(greys);
  for (double& grey : greys) grey -= middle;
  return RobustDeviation(std::move(greys));
}

// A grey difference and its derivatives.
struct Row {
  float derivatives[8];
  float residual;
  bool is_seen = false;
};

class RowMaker {
 public:
  RowMaker(const FrameLevel& frame, const PhotometricView& view, const GreyChange& change)
      : grey_(frame.grey),
        camera_(frame.color_camera),
        T_model_keyframe_(view.T_model_keyframe.matrix().topRows<3>().cast<float>()),
        gain_(static_cast<float>(change.gain)),
        offset_(static_cast<float>(change.offset)) {
    const RigidTransform T_color_model = view.T_color_depth * view.T_model_frame.inverse();
    T_color_model_ = T_color_model.matrix().topRows<3>().cast<float>();
  }

  Row Make(const GreyPoint& point) const {
    Row row;
    const Vec3f p_model =
        T_model_keyframe_.leftCols<3>() * point.p_keyframe + T_model_keyframe_.col(3);
    const Vec3f p = T_color_model_.leftCols<3>() * p_model + T_color_model_.col(3);
    if (p.z() <= 0) return row;
    const float inverse_z = 1 / p.z();
    const auto fx = static_cast<float>(camera_.fx), fy = static_cast<float>(camera_.fy);
    const float u = fx * p.x() * inverse_z + static_cast<float>(camera_.cx);
    const float v = fy * p.y() * inverse_z + static_cast<float>(camera_.cy);
    GreySample sample;
    if (!SampleGrey(grey_, u, v, sample)) return row;
    const float contrast = point.grey - kGreyMiddle;
    row.residual = sample.value - ((1 + gain_) * contrast + kGreyMiddle + offset_);
    // The frame moves by x: the point moves against it in the frame's camera.
    const float gx = sample.du * fx * inverse_z, gy = sample.dv * fy * inverse_z;
    const Vec3f by_camera(gx, gy, -(gx * p.x() + gy * p.y()) * inverse_z);
    const Vec3f by_model = -(T_color_model_.leftCols<3>().transpose() * by_camera);
    const Vec3f turn = p_model.cross(by_model);
    for (int i = 0; i < 3; ++i) {
      row.derivatives[i] = by_model[i];
      row.derivatives[3 + i] = turn[i];
    }
    row.derivatives[6] = -contrast;
    row.derivatives[7] = -1;
    row.is_seen = true;
    return row;
  }

 private:
  const Image<GreySample>& grey_;
  const PinholeCamera& camera_;
  Eigen::Matrix<float, 3, 4> T_model_keyframe_;
  Eigen::Matrix<float, 3, 4> T_color_model_;
  float gain_, offset_;
};

}  // namespace

Keyframe MakeKeyframe(const TrackingFrame& frame, const RigidTransform& T_world_camera,
                      const RigidTransform& T_color_depth) {
  Keyframe keyframe;
  keyframe.T_world_camera = T_world_camera;
  keyframe.median_depth = MedianDepth(frame.levels.back().depth);
  keyframe.levels.resize(frame.levels.size());
  ParallelFor(0, static_cast<int64_t>(frame.levels.size()), 1,
              [&](int64_t i) { keyframe.levels[i] = GreyPoints(frame.levels[i], T_color_depth); });
  keyframe.contrast = Contrast(keyframe.levels.front());
  return keyframe;
}

GreyChange ChangeBetween(const GreyStatistics& keyframe, const GreyStatistics& frame) {
  constexpr double kMaxRatio = 2;  // chosen: a stop from keyframe to frame
  GreyChange change;
  if (keyframe.deviation > 0 && frame.deviation > 0) {
    change.gain = std::clamp(frame.deviation / keyframe.deviation, 1 / kMaxRatio, kMaxRatio) - 1;
  }
  change.offset = frame.mean - kGreyMiddle - (1 + change.gain) * (keyframe.mean - kGreyMiddle);
  return change;
}

GreyChange MatchGrey(const std::vector<GreyPoint>& keyframe, const FrameLevel& frame,
                     const PhotometricView& view) {
  const RowMaker maker(frame, view, {});
  Eigen::Array2d sum = Eigen::Array2d::Zero(), squares = Eigen::Array2d::Zero();
  int count = 0;
  for (const GreyPoint& point : keyframe) {
    const Row row = maker.Make(point);
    if (!row.is_seen) continue;
    const Eigen::Array2d greys(point.grey, row.residual + point.grey);
    sum += greys;
    squares += greys * greys;
    ++count;
  }
  if (count < 2) return {};
  const Eigen::Array2d mean = sum / count;
  const Eigen::Array2d deviation = (squares / count - mean * mean).max(0).sqrt();
  return ChangeBetween({mean(0), deviation(0)}, {mean(1), deviation(1)});
}

PhotometricSums PhotometricTerm(const std::vector<GreyPoint>& keyframe, const FrameLevel& frame,
                                const PhotometricView& view, const GreyChange& change) {
  const RowMaker maker(frame, view, change);
  const auto count = static_cast<int64_t>(keyframe.size());
  std::vector<Row> rows(keyframe.size());
  ParallelFor(0, count, kPointsPerChunk, [&](int64_t i) { rows[i] = maker.Make(keyframe[i]); });
  std::vector<double> differences;
  for (const Row& row : rows) {
    if (row.is_seen) differences.push_back(row.residual);
  }
  PhotometricSums sums;
  sums.points = static_cast<int>(differences.size());
  sums.deviation = std::max(kMinDeviation, RobustDeviation(std::move(differences)));
  const auto limit = static_cast<float>(kTukeyLimit * sums.deviation);
  constexpr auto kInformation = static_cast<float>(1 / (kGreyNoise * kGreyNoise));
  for (const Row& row : rows) {
    if (!row.is_seen) continue;
    const float robust = TukeyWeight(row.residual / limit);
    if (robust > 0) sums.equations.Add(row.derivatives, row.residual, robust * kInformation);
  }
  return sums;
}

}  // namespace curvefusion
