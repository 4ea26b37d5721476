#include "fusion/tracking/geometric_term.h"

#include <cmath>
#include <vector>

#include "capture/depth_noise.h"
#include "kernel/parallel.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr int kBandRows = 8;   // of an image, for a thread at a time; chosen for speed
constexpr int kFitStride = 3;  // chosen: the deviation is taken of every third pixel, for speed
constexpr float kMaxDistance = 0.1;  // metres between paired points (KinectFusion 2011)
constexpr float kInlier = 3;         // standard deviations; chosen (docs/tracking.md#lost-frames)
// Metres. Chosen: a third of a voxel, what trilinear interpolation loses at edges; also keeps few
// near pixels from outweighing the room.
constexpr float kModelNoise = 0.003f;

struct Pair {
  Vec3f point;   // of the frame, in the model's camera
  Vec3f normal;  // of the model
  float distance;
  float noise;  // standard deviation of the distance
};

enum class Pairing { kNoDepth, kNoModel, kPaired };

class PairFinder {
 public:
  PairFinder(const FrameLevel& frame, const ModelLevel& model, const RigidTransform& T_model_frame)
      : frame_(frame),
        model_(model),
        R_(T_model_frame.linear().cast<float>()),
        t_(T_model_frame.translation().cast<float>()) {}

  Pairing Find(int u, int v, Pair& pair) const {
    const float z = frame_.depth(u, v);
    if (!(z > 0)) return Pairing::kNoDepth;
    const PinholeCamera& from = frame_.depth_camera;
    const Vec3f ray(
        (static_cast<float>(u) - static_cast<float>(from.cx)) / static_cast<float>(from.fx),
        (static_cast<float>(v) - static_cast<float>(from.cy)) / static_cast<float>(from.fy), 1);
    pair.point = R_ * (z * ray) + t_;
    if (pair.point.z() <= 0) return Pairing::kNoModel;
    const PinholeCamera& to = model_.camera;
    const float x = static_cast<float>(to.fx) * pair.point.x() / pair.point.z() +
                    static_cast<float>(to.cx) + 0.5f;
    const float y = static_cast<float>(to.fy) * pair.point.y() / pair.point.z() +
                    static_cast<float>(to.cy) + 0.5f;
    if (!(x >= 0 && y >= 0 && x < static_cast<float>(to.width) &&
          y < static_cast<float>(to.height))) {
      return Pairing::kNoModel;
    }
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    pair.normal = model_.normals(column, row);
    if (pair.normal.isZero(0)) return Pairing::kNoModel;
    const Vec3f offset = pair.point - model_.points(column, row);
    if (offset.squaredNorm() > kMaxDistance * kMaxDistance) return Pairing::kNoModel;
    pair.distance = pair.normal.dot(offset);
    // Noise runs along the frame's ray.
    const float sensor = static_cast<float>(DepthNoise(z)) * pair.normal.dot(R_ * ray);
    pair.noise = std::sqrt(sensor * sensor + kModelNoise * kModelNoise);
    return Pairing::kPaired;
  }

 private:
  const FrameLevel& frame_;
  const ModelLevel& model_;
  Eigen::Matrix3f R_;
  Vec3f t_;
};

}  // namespace

GeometricFit MeasureGeometricFit(const FrameLevel& frame, const ModelLevel& model,
                                 const RigidTransform& T_model_frame) {
  const PairFinder finder(frame, model, T_model_frame);
  GeometricFit fit;
  std::vector<double> distances;
  Pair pair;
  // Columns are staggered, so that no regular pattern is missed.
  for (int v = 0; v < frame.depth.height(); ++v) {
    for (int u = v % kFitStride; u < frame.depth.width(); u += kFitStride) {
      const Pairing pairing = finder.Find(u, v, pair);
      fit.measured += pairing != Pairing::kNoDepth;
      if (pairing != Pairing::kPaired) continue;
      const float ratio = std::abs(pair.distance) / pair.noise;
      fit.inliers += ratio < kInlier;
      distances.push_back(ratio);
    }
  }
  fit.overlapping = static_cast<int>(distances.size());
  fit.deviation = RobustDeviation(std::move(distances));
  return fit;
}

NormalEquations<6> GeometricTerm(const FrameLevel& frame, const ModelLevel& model,
                                 const RigidTransform& T_model_frame, double deviation) {
  const PairFinder finder(frame, model, T_model_frame);
  const auto limit = static_cast<float>(kTukeyLimit * deviation);
  const int height = frame.depth.height();
  std::vector<NormalEquations<6>> of_band((height + kBandRows - 1) / kBandRows);
  ParallelChunks(0, height, kBandRows, [&](int64_t first, int64_t last) {
    NormalEquations<6> sums;
    Pair pair;
    for (int v = static_cast<int>(first); v < last; ++v) {
      for (int u = 0; u < frame.depth.width(); ++u) {
        if (finder.Find(u, v, pair) != Pairing::kPaired) continue;
        const float robust = TukeyWeight(pair.distance / (limit * pair.noise));
        if (robust == 0) continue;
        const Vec3f turn = pair.point.cross(pair.normal);
        const float derivatives[6] = {pair.normal.x(), pair.normal.y(), pair.normal.z(),
                                      turn.x(),        turn.y(),        turn.z()};
        const float inverse_noise = 1 / pair.noise;
        sums.Add(derivatives, pair.distance, robust * inverse_noise * inverse_noise);
      }
    }
    of_band[first / kBandRows] = sums;
  });
  NormalEquations<6> sums;
  for (const NormalEquations<6>& band : of_band) sums.Add(band);
  return sums;
}

}  // namespace curvefusion
