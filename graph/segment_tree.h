#pragma once

#include <vector>

#include "kernel/geometry.h"
#include "kernel/polyline.h"

namespace curvefusion {

/// A tree of boxes over the segments of a polyline, for many questions about the distance to it.
/// Built in linear time; the polyline must have two points and outlive the tree.
class SegmentTree {
 public:
  explicit SegmentTree(const Polyline& points);

  /// Whether the polyline comes within a distance of p, limit included. Decided exactly. O(log n)
  /// but for degenerate curves; constant where p follows the curve from call to call.
  bool IsWithin(const Vec3& p, double distance) const;

 private:
  struct Box {
    Vec3 low;
    Vec3 high;
  };
  bool IsWithin(int box, const Vec3& p, double distance) const;
  bool IsSegmentWithin(int segment, const Vec3& p, double distance) const;

  const Polyline& points_;
  int leaves_ = 1;          // a power of two
  std::vector<Box> boxes_;  // children of box i are 2 i and 2 i + 1; leaf k is box leaves_ + k
  mutable int last_found_ = 0;
};

}  // namespace curvefusion
