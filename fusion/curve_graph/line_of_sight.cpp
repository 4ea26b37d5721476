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
  return views_.Behind(views_.views()[view_], line.start + at * line.step) < -kHiding;
}

// Image by image, in each of which places lie side by side: the images do not fit into caches.
std::vector<StripAgreement> LineOfSight::Looks(const std::vector<double>& distances,
                                               StripImage::Look look, size_t stride) const {
  const std::vector<float> at(distances.begin(), distances.end());
  Pixels in_color(at.size()), in_depth(at.size());
  std::vector<StripAgreement> agreements(at.size());
  for (size_t i = 0; i < lines_.size(); i += stride) {
    Project(lines_[i].color, at, PinholeCamera::kNearest, views_.color_camera(), in_color);
    Project(lines_[i].depth, at, 0, views_.depth_camera(), in_depth);
    Add(views_.views()[i], look, in_color, in_depth, agreements);
  }
  for (StripAgreement& agreement : agreements) agreement = agreement.Weighted(stride);
  return agreements;
}

CURVEFUSION_WIDE_LANES
void LineOfSight::Project(const Line& line, const std::vector<float>& distances, float nearest,
                          const PinholeCamera& camera, Pixels& pixels) {
  const auto width = static_cast<float>(camera.width), height = static_cast<float>(camera.height);
  const Vec3f start = line.start, step = line.step;
  const float* at = distances.data();
  float* z = pixels.z.data();
  int *us = pixels.u.data(), *vs = pixels.v.data(), *is_in = pixels.is_in.data();
  for (size_t k = 0; k < distances.size(); ++k) {
    z[k] = start.z() + at[k] * step.z();
    const float scale = 1 / z[k];
    const float u = (start.x() + at[k] * step.x()) * scale + 0.5F;
    const float v = (start.y() + at[k] * step.y()) * scale + 0.5F;
    is_in[k] = (z[k] > 0) & (z[k] >= nearest) & (u >= 0) & (v >= 0) & (u < width) & (v < height);
    us[k] = is_in[k] ? static_cast<int>(u) : 0;
    vs[k] = is_in[k] ? static_cast<int>(v) : 0;
  }
}

// Without branches, which would be mispredicted: half of the places are explained or hidden.
void LineOfSight::Add(const StripViews::View& view, StripImage::Look look, const Pixels& in_color,
                      const Pixels& in_depth, std::vector<StripAgreement>& agreements) {
  const Image<float> nothing(1, 1, 0);
  const Image<float>& farthest = view.farthest.empty() ? nothing : view.farthest;
  for (size_t k = 0; k < agreements.size(); ++k) {
    const int u = in_color.u[k], v = in_color.v[k];
    const float far = farthest(in_depth.u[k] / kDepthCellPx, in_depth.v[k] / kDepthCellPx);
    const int is_hidden = in_depth.is_in[k] & (far > 0) & (far - in_depth.z[k] < -kHiding);
    const int is_open = in_color.is_in[k] & !view.strips.IsExplained(u, v) & !is_hidden;
    const int is_seen = view.strips.IsSeen(look, u, v);
    StripAgreement& agreement = agreements[k];
    agreement.looked += is_open;
    agreement.seen += is_open & is_seen;
    agreement.evidence += is_open * view.strips.Evidence(look, is_seen, u, v);
    agreement.middle_evidence += (is_open & is_seen) * view.strips.MiddleEvidence(u, v);
  }
}

}  // namespace curvefusion
