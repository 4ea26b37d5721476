#include "graph/segment_tree.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "kernel/exact.h"

namespace curvefusion {

namespace {

// Far above the rounding of a distance from a box, so that boxes never hide a segment.
constexpr double kMargin = 1e-12;

}  // namespace

SegmentTree::SegmentTree(const Polyline& points) : points_(points) {
  assert(points.size() >= 2);
  const int segments = static_cast<int>(points.size()) - 1;
  while (leaves_ < segments) leaves_ *= 2;
  const Vec3 infinite = Vec3::Constant(std::numeric_limits<double>::infinity());
  boxes_.assign(2 * leaves_, {infinite, -infinite});
  for (int k = 0; k < segments; ++k)
    boxes_[leaves_ + k] = {points[k].cwiseMin(points[k + 1]), points[k].cwiseMax(points[k + 1])};
  for (int i = leaves_ - 1; i > 0; --i)
    boxes_[i] = {boxes_[2 * i].low.cwiseMin(boxes_[2 * i + 1].low),
                 boxes_[2 * i].high.cwiseMax(boxes_[2 * i + 1].high)};
}

bool SegmentTree::IsWithin(const Vec3& p, double distance) const {
  return IsSegmentWithin(last_found_, p, distance) || IsWithin(1, p, distance);
}

bool SegmentTree::IsSegmentWithin(int segment, const Vec3& p, double distance) const {
  return AreWithin({p, p}, {points_[segment], points_[segment + 1]}, distance);
}

bool SegmentTree::IsWithin(int box, const Vec3& p, double distance) const {
  const Vec3 outside = (boxes_[box].low - p).cwiseMax(p - boxes_[box].high).cwiseMax(0.0);
  const double margin = kMargin * (distance + p.cwiseAbs().maxCoeff());
  if (!(outside.norm() <= distance + margin)) return false;
  if (box < leaves_) return IsWithin(2 * box, p, distance) || IsWithin(2 * box + 1, p, distance);
  if (!IsSegmentWithin(box - leaves_, p, distance)) return false;
  last_found_ = box - leaves_;
  return true;
}

}  // namespace curvefusion
