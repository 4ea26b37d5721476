#include "fusion/paper/colour_edge_samples.h"

#include <algorithm>
#include <cmath>

#include "fusion/segmentation/colour_verification.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Takes a depth for a square of pixels where it is nearer than what stands there.
void Splat(const Vec2& pixel, double side, float z, DepthImage& registered) {
  const auto first = [&](double center) {
    return static_cast<int>(std::lround(center - side / 2 + 0.5));
  };
  const int count = std::max(1, static_cast<int>(std::lround(side)));
  for (int v = first(pixel.y()); v < first(pixel.y()) + count; ++v) {
    for (int u = first(pixel.x()); u < first(pixel.x()) + count; ++u) {
      if (!registered.Contains(u, v)) continue;
      float& at = registered(u, v);
      if (!(at > 0) || z < at) at = z;
    }
  }
}

std::vector<Vec3> LiftFrame(const Sequence& sequence, int frame, const CurveEdgeOptions& options) {
  const MaskImage edges =
      ColourEdges(LoadColor(sequence, frame), {options.low_threshold, options.high_threshold});
  const DepthImage registered = RegisteredDepth(LoadDepth(sequence, frame), sequence);
  const RigidTransform T_depth_color = sequence.T_color_depth.inverse();
  std::vector<Vec3> samples;
  for (int v = 0; v < edges.height(); ++v) {
    for (int u = 0; u < edges.width(); ++u) {
      if (!edges(u, v) || !(registered(u, v) > 0)) continue;
      samples.push_back(T_depth_color * sequence.color_camera.Unproject(u, v, registered(u, v)));
    }
  }
  return samples;
}

}  // namespace

void VisitOptions(CurveEdgeOptions& options, OptionVisitor& visitor) {
  visitor.Visit(
      {"low_threshold", "grey levels", 0, 2000,
       "Gradient at which a colour edge goes on (Canny). CurveFusion 4.1 gives no value."},
      options.low_threshold);
  visitor.Visit({"high_threshold", "grey levels", 0, 2000,
                 "Gradient at which a colour edge begins (Canny). CurveFusion 4.1 gives no value."},
                options.high_threshold);
}

DepthImage RegisteredDepth(const DepthImage& depth, const Sequence& sequence) {
  const PinholeCamera& color = sequence.color_camera;
  DepthImage registered(color.width, color.height, 0);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (!(depth(u, v) > 0)) continue;
      const Vec3 p_color =
          sequence.T_color_depth * sequence.depth_camera.Unproject(u, v, depth(u, v));
      if (p_color.z() <= 0) continue;
      const double side = color.fx / p_color.z() * depth(u, v) / sequence.depth_camera.fx;
      Splat(color.Project(p_color), side, static_cast<float>(p_color.z()), registered);
    }
  }
  return registered;
}

std::vector<Vec3> LiftColourEdges(const Sequence& sequence, const BundleFrames& frames,
                                  const CurveEdgeOptions& options) {
  const auto [first, last] = frames;
  const RigidTransform T_bundle_world = sequence.frames[first].T_world_camera.inverse();
  std::vector<std::vector<Vec3>> of_frame(last - first);
  ParallelFor(0, last - first, 1, [&](int64_t i) {
    const int frame = first + static_cast<int>(i);
    of_frame[i] = LiftFrame(sequence, frame, options);
    const RigidTransform T_bundle_camera = T_bundle_world * sequence.frames[frame].T_world_camera;
    for (Vec3& sample : of_frame[i]) sample = T_bundle_camera * sample;
  });
  std::vector<Vec3> samples;
  for (const std::vector<Vec3>& frame : of_frame) {
    samples.insert(samples.end(), frame.begin(), frame.end());
  }
  return samples;
}

}  // namespace curvefusion
