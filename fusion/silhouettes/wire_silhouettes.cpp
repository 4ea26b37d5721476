#include "fusion/silhouettes/wire_silhouettes.h"

#include <algorithm>
#include <cstdint>

#include "capture/farthest_depth.h"
#include "capture/frame_stream.h"
#include "fusion/curve_graph/strip_views.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr uint8_t kWire = 128;  // derived, half of 255: least posterior of a pixel that shows wire

// The greatest depth within the 3 x 3 cells around each cell: block matching widens thin things.
Image<float> FarthestAround(const DepthImage& depth) {
  const Image<float> cells = FarthestInCells(depth);
  Image<float> around(cells.width(), cells.height());
  for (int v = 0; v < cells.height(); ++v) {
    for (int u = 0; u < cells.width(); ++u) {
      for (int b = std::max(0, v - 1); b <= std::min(cells.height() - 1, v + 1); ++b)
        for (int a = std::max(0, u - 1); a <= std::min(cells.width() - 1, u + 1); ++a)
          around(u, v) = std::max(around(u, v), cells(a, b));
    }
  }
  return around;
}

}  // namespace

WireSilhouettes::WireSilhouettes(const Sequence& sequence, const std::vector<int>& frames,
                                 const std::vector<PosteriorImage>& posteriors, int max_frames)
    : depth_camera_(sequence.depth_camera), color_camera_(sequence.color_camera) {
  const std::vector<int> used = EvenlyThinned(frames, max_frames);
  ForEachFrame(sequence, used, {.depth = true, .color = false}, [&](const DecodedFrame& frame) {
    const auto place = std::lower_bound(frames.begin(), frames.end(), frame.index);
    const RigidTransform T_depth_world = sequence.frames[frame.index].T_world_camera.inverse();
    views_.push_back({T_depth_world, sequence.T_color_depth * T_depth_world,
                      &posteriors[place - frames.begin()], FarthestAround(frame.depth)});
  });
}

bool WireSilhouettes::IsHidden(const View& view, const Vec3& p_depth) const {
  if (p_depth.z() <= 0) return false;
  const Vec2 pixel = depth_camera_.Project(p_depth);
  if (!depth_camera_.Contains(pixel)) return false;
  const Eigen::Vector2i at = PinholeCamera::Rounded(pixel);
  const float farthest = view.farthest(at.x() / kDepthCellPx, at.y() / kDepthCellPx);
  return farthest > 0 &&
         farthest < static_cast<float>(p_depth.z()) - static_cast<float>(kHidingDistance);
}

ViewCount WireSilhouettes::Count(const Vec3& p) const {
  ViewCount count;
  for (const View& view : views_) {
    const Vec3 p_color = view.T_color_world * p;
    if (p_color.z() <= 0) continue;
    const Vec2 pixel = color_camera_.Project(p_color);
    if (!color_camera_.Contains(pixel)) continue;
    const Eigen::Vector2i at = PinholeCamera::Rounded(pixel);
    const bool is_wire = (*view.posterior)(at.x(), at.y()) >= kWire;
    if (!is_wire && IsHidden(view, view.T_depth_world * p)) continue;
    ++count.looked;
    count.seen += is_wire ? 1 : 0;
  }
  return count;
}

double WireSilhouettes::Share(const Vec3& p, double untold) const {
  const ViewCount count = Count(p);
  return count.looked < StripAgreement::kMinLooks ? untold
                                                  : static_cast<double>(count.seen) / count.looked;
}

std::vector<double> WireSilhouettes::SharesAlong(const Polyline& points, double untold) const {
  constexpr int64_t kPointsPerChunk = 16;  // chosen: of one task
  std::vector<double> shares(points.size());
  ParallelFor(0, static_cast<int64_t>(points.size()), kPointsPerChunk,
              [&](int64_t i) { shares[i] = Share(points[i], untold); });
  return shares;
}

}  // namespace curvefusion
