#include "experiments/baselines/silhouette_maps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "capture/frame_stream.h"
#include "experiments/baselines/volumetric_fusion.h"
#include "experiments/simulation/scene.h"
#include "experiments/simulation/scene_view.h"
#include "fusion/appearance/wire_posterior.h"
#include "fusion/paper/surface_removal.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Frames from which the colours are learnt; chosen: about a million pixels of background and, at
// half a percent, ten thousand of wire, for histograms of some hundred occupied cells.
constexpr int kModelFrames = 10;

Scene TubesOf(const SkeletonGraph& truth) {
  Scene scene;
  for (const EdgeId id : truth.Edges()) {
    const SkeletonEdge& edge = truth.edge(id);
    for (size_t i = 1; i < edge.points.size(); ++i) {
      scene.capsules.push_back(
          {edge.points[i - 1], edge.points[i], (edge.radii[i - 1] + edge.radii[i]) / 2});
    }
  }
  return scene;
}

// Pixels of a colour image that thin depth falls on.
MaskImage ThinPixels(const Sequence& sequence, int frame, const TsdfVolume& volume,
                     const SurfaceRemovalOptions& options) {
  const PinholeCamera& camera = sequence.color_camera;
  MaskImage thin(camera.width, camera.height, 0);
  const ObservedPoints points =
      FindBundleDifference(sequence, {frame, frame + 1}, volume, options).points;
  for (const Vec3& p_depth : points.positions) {
    const Vec3 p = sequence.T_color_depth * p_depth;
    if (p.z() <= 0 || !camera.Contains(camera.Project(p))) continue;
    const Eigen::Vector2i pixel = PinholeCamera::Rounded(camera.Project(p));
    thin(pixel.x(), pixel.y()) = 1;
  }
  return thin;
}

void AddPixels(const ColourBins& bins, const MaskImage& thin, WireColourModel& model) {
  for (size_t i = 0; i < bins.size(); ++i) {
    if (thin.data()[i] != 0) {
      model.AddWire(bins.data()[i]);
    } else {
      model.AddBackground(bins.data()[i]);
    }
  }
}

Image<float> ProbabilityOf(const PosteriorImage& posterior) {
  Image<float> probability(posterior.width(), posterior.height());
  std::transform(posterior.data(), posterior.data() + posterior.size(), probability.data(),
                 [](uint8_t value) { return static_cast<float>(value) / 255; });
  return probability;
}

}  // namespace

RigidTransform PoseTowards(const Vec3& center, const Vec3& away, double distance) {
  RigidTransform T_world_camera = RigidTransform::Identity();
  T_world_camera.linear().col(0) = away.unitOrthogonal();
  T_world_camera.linear().col(1) = -away.cross(away.unitOrthogonal());
  T_world_camera.linear().col(2) = -away;
  T_world_camera.translation() = center + distance * away;
  return T_world_camera;
}

std::vector<RigidTransform> PosesAround(const Vec3& center, double distance, int count) {
  std::vector<RigidTransform> poses;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count;
    const double around = 2 * std::numbers::pi * i / std::numbers::phi;
    const double width = std::sqrt(1 - z * z);
    const Vec3 away(width * std::cos(around), width * std::sin(around), z);
    poses.push_back(PoseTowards(center, away, distance));
  }
  return poses;
}

std::vector<SilhouetteMap> TrueSilhouettes(const SkeletonGraph& truth, const PinholeCamera& camera,
                                           const std::vector<RigidTransform>& T_world_camera) {
  const Scene scene = TubesOf(truth);
  std::vector<SilhouetteMap> maps(T_world_camera.size());
  ParallelFor(0, static_cast<int64_t>(maps.size()), 1, [&](int64_t i) {
    SilhouetteMap& map = maps[i];
    map = {camera, T_world_camera[i], Image<float>(camera.width, camera.height, 0)};
    const SceneView view(scene, camera, map.T_world_camera, map.T_world_camera);
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        map.probability(u, v) = view.Trace(u, v).primitive >= 0 ? 1 : 0;
      }
    }
  });
  return maps;
}

std::vector<SilhouetteMap> ColourSilhouettes(const Sequence& sequence,
                                             const std::vector<int>& frames,
                                             const PaperOptions& options,
                                             const Progress& progress) {
  const TsdfVolume volume = FusedVolume(sequence, options.volume, progress);
  WireColourModel model;
  bool is_wire_seen = false;
  for (const int frame : EvenlyThinned(frames, kModelFrames)) {
    const MaskImage thin = ThinPixels(sequence, frame, volume, options.surfaces);
    AddPixels(BinColours(LoadColor(sequence, frame)), thin, model);
    is_wire_seen = is_wire_seen || AnySet(thin);
  }
  std::vector<SilhouetteMap> maps;
  if (!is_wire_seen) return maps;
  const std::vector<uint8_t> posterior = model.Posterior();
  for (const int frame : frames) {
    const ColourBins bins = BinColours(LoadColor(sequence, frame));
    maps.push_back({sequence.color_camera,
                    sequence.frames[frame].T_world_camera * sequence.T_color_depth.inverse(),
                    ProbabilityOf(ApplyPosterior(bins, posterior))});
    progress("silhouettes", static_cast<int64_t>(maps.size()), static_cast<int64_t>(frames.size()));
  }
  return maps;
}

}  // namespace curvefusion
