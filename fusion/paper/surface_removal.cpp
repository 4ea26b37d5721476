#include "fusion/paper/surface_removal.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "capture/depth_noise.h"
#include "fusion/segmentation/depth_opening.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

DepthOpeningOptions Opening(const SurfaceRemovalOptions& options) {
  DepthOpeningOptions opening;
  opening.radius = options.opening_radius;
  opening.discontinuity = options.discontinuity;
  return opening;
}

// Metres. Chosen for a Kinect V1: nearer depth is below its range; farther depth lies on no thin
// structure (noise of three standard deviations, 38 mm, exceeds the thickness of what is scanned by
// far).
constexpr double kMinDepth = 0.2;
constexpr double kMaxDepth = 3.0;

// How far from a large surface a depth must lie.
double Separation(double depth, const SurfaceRemovalOptions& options) {
  return std::max(options.separation, kClearDeviations * DepthNoise(depth));
}

// Whether a surface that opening has left comes nearer to a depth pixel than `separation`.
bool IsNearSurface(int u, int v, float depth, const DepthImage& opened, const PinholeCamera& camera,
                   double separation) {
  const Vec3 p = camera.Unproject(u, v, depth);
  const int reach = static_cast<int>(std::ceil(camera.fx * separation / depth));
  for (int y = std::max(0, v - reach); y <= std::min(opened.height() - 1, v + reach); ++y) {
    for (int x = std::max(0, u - reach); x <= std::min(opened.width() - 1, u + reach); ++x) {
      if (std::abs(opened(x, y) - depth) > separation) continue;
      if ((camera.Unproject(x, y, opened(x, y)) - p).norm() < separation) return true;
    }
  }
  return false;
}

// Whether a depth is not explained by the rendering, of which opening has left `opened`.
bool IsThin(int u, int v, float depth, const DepthImage& rendering, const DepthImage& opened,
            const PinholeCamera& camera, const SurfaceRemovalOptions& options) {
  if (depth < kMinDepth || depth > kMaxDepth) return false;
  const bool is_rendered = rendering(u, v) > 0;
  if (!is_rendered && !options.keep_unrendered) return false;
  const double separation = Separation(depth, options);
  const bool is_removed = is_rendered && !(opened(u, v) > 0);
  if (is_removed && depth > rendering(u, v) + separation) return false;  // seen past a thin part
  if (opened(u, v) > 0 && depth > opened(u, v) - separation) return false;
  return !IsNearSurface(u, v, depth, opened, camera, separation);
}

// "Difference of these resulting depth renderings from the corresponding original depth maps yields
// a point cloud called image difference set."
ObservedPoints ImageDifference(const DepthImage& depth, const PinholeCamera& camera,
                               const RigidTransform& T_world_camera, const TsdfVolume& volume,
                               const SurfaceRemovalOptions& options) {
  const DepthImage rendering = volume.Raycast(camera, T_world_camera);
  const DepthImage opened = OpenDepth(rendering, camera, {}, Opening(options));
  ObservedPoints points;
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (!IsThin(u, v, depth(u, v), rendering, opened, camera, options)) continue;
      const Vec3 p_camera = camera.Unproject(u, v, depth(u, v));
      points.Add(p_camera, p_camera.normalized(), 1);
    }
  }
  return points;
}

}  // namespace

void VisitOptions(SurfaceRemovalOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"opening_radius", "m", 0.001, 0.5,
                 "Surfaces of the rendered volume are eroded and dilated by so much; what is "
                 "narrower than twice that goes. CurveFusion 4.1."},
                options.opening_radius);
  visitor.Visit({"discontinuity", "m", 0.001, 0.5,
                 "A step of the rendering's depth above that is an edge, unless the surface is as "
                 "steep beside it. CurveFusion 4.1 gives no value."},
                options.discontinuity);
  visitor.Visit({"separation", "m", 0, 0.2,
                 "Depth nearer than this to a large surface belongs to it. CurveFusion 4, "
                 "assumption (i): 2 to 5 cm depending on depth."},
                options.separation);
  visitor.Visit({"keep_unrendered", "", 0, 1,
                 "Whether depth stays where the volume shows no surface: for scanners of short "
                 "range. CurveFusion 4.1 says neither."},
                options.keep_unrendered);
}

BundleDifference FindBundleDifference(const Sequence& sequence, const BundleFrames& frames,
                                      const TsdfVolume& volume,
                                      const SurfaceRemovalOptions& options) {
  const auto [first, last] = frames;
  const RigidTransform T_bundle_world = sequence.frames[first].T_world_camera.inverse();
  std::vector<BundleDifference> of_frame(last - first);
  ParallelFor(0, last - first, 1, [&](int64_t i) {
    const int frame = first + static_cast<int>(i);
    const RigidTransform& T_world_camera = sequence.frames[frame].T_world_camera;
    const DepthImage depth = LoadDepth(sequence, frame);
    of_frame[i].points =
        Transformed(ImageDifference(depth, sequence.depth_camera, T_world_camera, volume, options),
                    T_bundle_world * T_world_camera);
    of_frame[i].depth_pixels = CountMeasured(depth);
  });
  BundleDifference difference;
  for (const BundleDifference& frame : of_frame) {
    Append(difference.points, frame.points);
    difference.depth_pixels += frame.depth_pixels;
  }
  return difference;
}

}  // namespace curvefusion
