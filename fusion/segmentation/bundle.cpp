#include "fusion/segmentation/bundle.h"

#include <algorithm>

namespace curvefusion {

void VisitOptions(BundleOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"frames", "frames", 1, 100000,
                 "Consecutive frames merged before a skeleton is extracted. CurveFusion 4.1, k."},
                options.frames);
  visitor.Visit({"voxel_size", "m", 0.0005, 0.05,
                 "Grid on which the merged points are resampled. CurveFusion 4.1."},
                options.voxel_size);
  visitor.Visit({"min_frames", "frames", 1, 1000,
                 "Deviation: points seen in fewer frames are dropped; noise does not come back at "
                 "the same place."},
                options.min_frames);
}

std::vector<std::pair<int, int>> SplitIntoBundles(int frame_count, int frames_per_bundle) {
  std::vector<std::pair<int, int>> bundles;
  for (int first = 0; first < frame_count; first += frames_per_bundle) {
    bundles.emplace_back(first, std::min(first + frames_per_bundle, frame_count));
  }
  if (bundles.size() > 1 &&
      2 * (bundles.back().second - bundles.back().first) < frames_per_bundle) {
    bundles.pop_back();
    bundles.back().second = frame_count;
  }
  return bundles;
}

BundleDifferenceSet::Voxel& BundleDifferenceSet::VoxelAt(const Vec3& p_bundle) {
  const auto number = static_cast<size_t>(numbers_.Number(VoxelOf(p_bundle, options_.voxel_size)));
  if (number == voxels_.size()) voxels_.emplace_back();
  return voxels_[number];
}

void BundleDifferenceSet::AddFrame(const MaskImage& mask, const MaskImage& on_edge,
                                   const DepthImage& depth, const PinholeCamera& camera,
                                   const RigidTransform& T_bundle_camera) {
  const int frame = frame_count_++;
  for (int v = 0; v < mask.height(); ++v) {
    for (int u = 0; u < mask.width(); ++u) {
      if (!mask(u, v)) continue;
      const Vec3 p_camera = camera.Unproject(u, v, depth(u, v));
      const Vec3 p_bundle = T_bundle_camera * p_camera;
      Voxel& voxel = VoxelAt(p_bundle);
      if (voxel.sightings.empty() || voxel.sightings.back().frame != frame) {
        voxel.sightings.push_back({});
        voxel.sightings.back().frame = frame;
      }
      Sighting& sighting = voxel.sightings.back();
      sighting.position_sum += p_bundle;
      sighting.ray_sum += T_bundle_camera.linear() * p_camera.normalized();
      ++sighting.pixels;
      voxel.on_edge |= on_edge(u, v) != 0;
    }
  }
}

bool BundleDifferenceSet::IsSeenAround(const VoxelKey& key, int min_frames,
                                       std::vector<int>& frames) const {
  frames.clear();
  const auto add_frames = [&](int voxel) {
    for (const Sighting& sighting : voxels_[voxel].sightings) {
      if (std::find(frames.begin(), frames.end(), sighting.frame) != frames.end()) continue;
      frames.push_back(sighting.frame);
      if (static_cast<int>(frames.size()) >= min_frames) return true;
    }
    return false;
  };
  // Most are seen often enough themselves.
  if (add_frames(numbers_.Find(key))) return true;
  for (int i = 0; i < 27; ++i) {
    const int voxel = numbers_.Find({key.x + i % 3 - 1, key.y + i / 3 % 3 - 1, key.z + i / 9 - 1});
    if (voxel != VoxelNumbers::kNone && add_frames(voxel)) return true;
  }
  return false;
}

BundlePoints BundleDifferenceSet::Points() const {
  BundlePoints bundle;
  const int min_frames = std::min(options_.min_frames, frame_count_);
  std::vector<int> frames;
  for (size_t i = 0; i < voxels_.size(); ++i) {
    const VoxelKey& key = numbers_.key(static_cast<int>(i));
    if (min_frames > 1 && !IsSeenAround(key, min_frames, frames)) continue;
    Vec3 position_sum = Vec3::Zero(), ray_sum = Vec3::Zero();
    int pixels = 0;
    for (const Sighting& sighting : voxels_[i].sightings) {
      position_sum += sighting.position_sum;
      ray_sum += sighting.ray_sum;
      pixels += sighting.pixels;
    }
    bundle.points.Add(position_sum / pixels, ray_sum.normalized(), static_cast<float>(pixels));
    bundle.on_edge.push_back(voxels_[i].on_edge);
    bundle.voxels.push_back(static_cast<int>(i));
  }
  return bundle;
}

std::vector<ObservedPoints> BundleDifferenceSet::FramePoints(const std::vector<int>& voxels) const {
  std::vector<ObservedPoints> frames(frame_count_);
  for (const int voxel : voxels) {
    for (const Sighting& sighting : voxels_[voxel].sightings) {
      frames[sighting.frame].Add(sighting.position_sum / sighting.pixels,
                                 sighting.ray_sum.normalized(),
                                 static_cast<float>(sighting.pixels));
    }
  }
  return frames;
}

}  // namespace curvefusion
