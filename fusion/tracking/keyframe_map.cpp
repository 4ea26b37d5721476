#include "fusion/tracking/keyframe_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace curvefusion {

namespace {

// A turn and a shift over the depth after which a keyframe is as far as 1. Chosen on fr1_rpy: an
// eighth of the view, so that keyframes share most of theirs.
constexpr double kTurn = 0.12;
constexpr double kShift = 0.12;
constexpr double kShared = 3;   // three eighths of the view: farther ones share too little
constexpr int kAlikeBlock = 4;  // pixels of the coarsest level along a side of those compared

double Farness(const Keyframe& keyframe, const RigidTransform& T_world_camera) {
  const RigidTransform motion = keyframe.T_world_camera.inverse() * T_world_camera;
  const double turn = Eigen::AngleAxisd(motion.linear()).angle() / kTurn;
  const double shift =
      motion.translation().norm() / (kShift * std::max(keyframe.median_depth, 0.1));
  return std::hypot(turn, shift);
}

// Means of blocks, less their mean, of unit norm.
std::vector<float> Signature(const Image<GreySample>& grey) {
  std::vector<float> means;
  for (int v = 0; v + kAlikeBlock <= grey.height(); v += kAlikeBlock) {
    for (int u = 0; u + kAlikeBlock <= grey.width(); u += kAlikeBlock) {
      float sum = 0;
      for (int y = v; y < v + kAlikeBlock; ++y) {
        for (int x = u; x < u + kAlikeBlock; ++x) sum += grey(x, y).value;
      }
      means.push_back(sum);
    }
  }
  Eigen::Map<Eigen::VectorXf> vector(means.data(), static_cast<Eigen::Index>(means.size()));
  if (means.empty()) return means;
  vector.array() -= vector.mean();
  vector.normalize();
  return means;
}

double Likeness(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

const KeyframeMap::Entry* KeyframeMap::Nearest(const RigidTransform& T_world_camera) const {
  const Entry* nearest = nullptr;
  double least = kShared;
  for (const Entry& entry : entries_) {
    const double farness = Farness(entry.keyframe, T_world_camera);
    if (farness >= least) continue;
    least = farness;
    nearest = &entry;
  }
  return nearest;
}

std::vector<const KeyframeMap::Entry*> KeyframeMap::MostAlike(const FrameLevel& coarsest,
                                                              int count) const {
  const std::vector<float> signature = Signature(coarsest.grey);
  std::vector<std::pair<double, const Entry*>> ranked;
  for (const Entry& entry : entries_) {
    ranked.emplace_back(-Likeness(signature, Signature(entry.coarsest.grey)), &entry);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<const Entry*> alike;
  for (const auto& [rank, entry] : ranked) {
    if (static_cast<int>(alike.size()) < count) alike.push_back(entry);
  }
  return alike;
}

void KeyframeMap::AddIfNew(const TrackingFrame& frame, const RigidTransform& T_world_camera,
                           const RigidTransform& T_color_depth) {
  const Entry* nearest = Nearest(T_world_camera);
  if (nearest != nullptr && Farness(nearest->keyframe, T_world_camera) < 1) return;
  entries_.push_back({MakeKeyframe(frame, T_world_camera, T_color_depth), frame.levels.back()});
}

}  // namespace curvefusion
