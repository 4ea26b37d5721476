#include "fusion/appearance/curves_in_front.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "capture/image_mat.h"

namespace curvefusion {

namespace {

constexpr double kBlurredPx = 2;  // chosen: to either side of a wire

// As an image shows it.
struct Segment {
  double depth = 0;
  int width = 0;
  Eigen::Vector2i from, to;
};

std::vector<Segment> SegmentsIn(const SkeletonGraph& skeleton, const PinholeCamera& camera,
                                const RigidTransform& T_camera_world) {
  std::vector<Segment> segments;
  for (const EdgeId id : skeleton.Edges()) {
    const SkeletonEdge& edge = skeleton.edge(id);
    for (size_t i = 0; i + 1 < edge.points.size(); ++i) {
      const Vec3 a = T_camera_world * edge.points[i], b = T_camera_world * edge.points[i + 1];
      const double depth = std::min(a.z(), b.z());
      if (depth < PinholeCamera::kNearest) continue;
      const double radius = edge.radii.empty() ? 0 : edge.radii[i];
      const double width = 2 * (radius * camera.fx / depth + kBlurredPx);
      segments.push_back({0.5 * (a + b).z(), static_cast<int>(std::ceil(width)),
                          PinholeCamera::Rounded(camera.Project(a)),
                          PinholeCamera::Rounded(camera.Project(b))});
    }
  }
  return segments;
}

}  // namespace

CurvesInFront::CurvesInFront(const SkeletonGraph& skeleton, const PinholeCamera& camera,
                             const RigidTransform& T_camera_world)
    : nearest_(camera.width, camera.height, 0) {
  std::vector<Segment> segments = SegmentsIn(skeleton, camera, T_camera_world);
  std::stable_sort(segments.begin(), segments.end(),
                   [](const Segment& a, const Segment& b) { return a.depth > b.depth; });
  cv::Mat pixels = MatOf(nearest_);
  for (const Segment& segment : segments) {
    cv::line(pixels, {segment.from.x(), segment.from.y()}, {segment.to.x(), segment.to.y()},
             segment.depth, segment.width);
  }
}

}  // namespace curvefusion
