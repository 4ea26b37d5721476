#include "fusion/funnel.h"

namespace curvefusion {

void PointFunnel::Add(const PointFunnel& other) {
  const auto all = static_cast<double>(frames + other.frames);
  if (all > 0) {
    chroma =
        (chroma * static_cast<double>(frames) + other.chroma * static_cast<double>(other.frames)) /
        all;
  }
  frames += other.frames;
  depth_pixels += other.depth_pixels;
  thin_pixels += other.thin_pixels;
  gated_pixels += other.gated_pixels;
  merged_points += other.merged_points;
  too_few_frames += other.too_few_frames;
  small_clusters += other.small_clusters;
  unverified += other.unverified;
  isolated += other.isolated;
  points += other.points;
}

}  // namespace curvefusion
