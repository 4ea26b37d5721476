#pragma once

#include <vector>

#include "kernel/geometry.h"
#include "kernel/image.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

/// The centre lines of a silhouette, one pixel wide: thinning of Guo and Hall 1989, "Parallel
/// Thinning with Two-Subiteration Algorithms". What is connected stays connected.
MaskImage Thinned(const MaskImage& silhouette);

/// A curve of an image between two ends or junctions, a point a pixel.
struct ImageCurve {
  std::vector<Vec2> points;    ///< in pixels, smoothed along the curve
  std::vector<Vec2> tangents;  ///< unit directions
};

/// The curves of centre lines, split where they meet. Twigs of less than `least_pixels` that hang
/// at a junction, as thinning leaves them, are taken off first; what is shorter otherwise is kept.
std::vector<ImageCurve> SplitAtJunctions(MaskImage centre_lines, int least_pixels);

/// All curves of an image, to be asked for the nearest point of any. Points are numbered through
/// all curves.
class ImageCurves {
 public:
  explicit ImageCurves(const std::vector<ImageCurve>& curves);

  int size() const { return static_cast<int>(points_.size()); }
  const Vec2& point(int i) const { return points_[i]; }
  const Vec2& tangent(int i) const { return tangents_[i]; }

  /// The numbers at which the curves begin, and the number of all points.
  const std::vector<int>& begins() const { return begins_; }

  /// Number of the nearest point, -1 where there are no curves.
  int Nearest(const Vec2& pixel) const;

  /// Numbers of all points within a distance, into `found`.
  void Within(const Vec2& pixel, double distance, std::vector<int>& found) const;

 private:
  std::vector<Vec2> points_;
  std::vector<Vec2> tangents_;
  std::vector<int> begins_;
  PointIndex index_;
};

}  // namespace curvefusion
