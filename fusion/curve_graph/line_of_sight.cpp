#include "fusion/curve_graph/line_of_sight.h"

#include "capture/farthest_depth.h"
#include "kernel/wide_lanes.h"

namespace curvefusion {

namespace {

constexpr auto kHiding = static_cast<float>(kHidingDistance);

}  // namespace

LineOfSight::LineOfSight(const StripViews& views, size_t view, const Vec3& direction)
    : views_(views), view_(view), start_(views.views()[view].center), direction_(direction) {
  const Eigen::Vector4f start = start_.cast<float>().homogeneous();
  const Vec3f ray = direction.cast<float>();
  lines_.reserve(views.views().size());
  for (const StripViews::View& other : views.views()) {
    lines_.push_back(
        {{other.color_from_world * start, other.color_from_world.leftCols<3>() * ray},
         {other.depth_from_world * start, other.depth_from_world.leftCols<3>() * ray}});
  }
}

bool LineOfSight::IsHidden(double distance) const {
  const Line& line = lines_[view_].depth;
  const auto at = static_cast<float>(distance);
  return views_.IsHidden(views_.views()[view_], line.start + at * line.step);
}

// Image by image, in each of which places lie side by side: the images do not fit into caches.
std::vector<StripAgreement> LineOfSight::Looks(const std::vector<double>& distances,
                                               StripImage::Look look, size_t stride) const {
  const std::vector<float> at(distances.begin(), distances.end());
  std::vector<float> z(at.size());
  LookedAt places(at.size()), in_depth(at.size());
  std::vector<StripAgreement> agreements(at.size());
  for (size_t i = 0; i < lines_.size(); i += stride) {
    const StripViews::View& view = views_.views()[i];
    Project(lines_[i].color, at, PinholeCamera::kNearest, views_.color_camera(), z, places);
    if (!view.farthest.empty()) {
      Project(lines_[i].depth, at, 0, views_.depth_camera(), z, in_depth);
      LeaveOutHidden(z, in_depth, view.farthest, places);
    }
    view.strips.AddTo(look, places, agreements);
  }
  for (StripAgreement& agreement : agreements) agreement = agreement.Weighted(stride);
  return agreements;
}

// Outside of the image pixels are 0.
CURVEFUSION_WIDE_LANES
void LineOfSight::Project(const Line& line, const std::vector<float>& distances, float nearest,
                          const PinholeCamera& camera, std::vector<float>& z, LookedAt& places) {
  const auto width = static_cast<float>(camera.width), height = static_cast<float>(camera.height);
  const Vec3f start = line.start, step = line.step;
  const float* at = distances.data();
  float* depth = z.data();
  int *us = places.u.data(), *vs = places.v.data(), *is_in = places.is_open.data();
  for (size_t k = 0; k < distances.size(); ++k) {
    depth[k] = start.z() + at[k] * step.z();
    const float scale = 1 / depth[k];
    const float u = (start.x() + at[k] * step.x()) * scale + 0.5F;
    const float v = (start.y() + at[k] * step.y()) * scale + 0.5F;
    is_in[k] =
        (depth[k] > 0) & (depth[k] >= nearest) & (u >= 0) & (v >= 0) & (u < width) & (v < height);
    us[k] = is_in[k] ? static_cast<int>(u) : 0;
    vs[k] = is_in[k] ? static_cast<int>(v) : 0;
  }
}

void LineOfSight::LeaveOutHidden(const std::vector<float>& z, const LookedAt& in_depth,
                                 const Image<float>& farthest, LookedAt& places) {
  const float* cells = farthest.data();
  const int width = farthest.width();
  for (size_t k = 0; k < z.size(); ++k) {
    const float far = cells[in_depth.v[k] / kDepthCellPx * width + in_depth.u[k] / kDepthCellPx];
    const int is_hidden = in_depth.is_open[k] & (far > 0) & (far - z[k] < -kHiding);
    places.is_open[k] &= 1 - is_hidden;
  }
}

}  // namespace curvefusion
