#pragma once

#include <functional>
#include <vector>

#include "kernel/polyline.h"

namespace curvefusion {

// Shapes that objects of a family are made of, in millimetres.

/// A smooth curve through knots, each of which becomes a vertex: a centripetal Catmull-Rom spline.
Polyline SmoothThrough(const Polyline& knots, double step = 6);

/// A straight line with vertices every `step` or less.
Polyline Straight(const Vec3& from, const Vec3& to, double step = 8);

/// A curve in the xy plane from the origin along x whose curvature (1/mm, positive to the left) is
/// a function of arc length.
Polyline PlaneCurve(double length, const std::function<double(double)>& curvature, double step = 2);

/// The least distance between points of a curve that lie at least `apart` from each other along it.
double SelfDistance(const Polyline& points, double apart, bool closed);

/// Lines of a surface on which wires run and cross: column lines u = 0, 1, ... and row lines v = 0,
/// 1, ... Lines cross in shared vertices.
class Lattice {
 public:
  /// `closed`: the last column joins the first, so that rows are loops.
  Lattice(int columns, int rows, bool closed, const std::function<Vec3(double u, double v)>& at);

  /// Of a closed lattice without repeating its first point. `first` and `last` are columns.
  Polyline Row(int row) const { return RowPart(row, 0, columns_); }
  Polyline RowPart(int row, int first, int last) const;
  Polyline Column(int column) const { return ColumnPart(column, 0, rows_); }
  Polyline ColumnPart(int column, int first, int last) const;

  const Vec3& At(int column, int row) const { return Point(column * kFine, row * kFine); }

 private:
  static constexpr int kFine = 4;  // vertices a cell's side
  const Vec3& Point(int x, int y) const { return points_[y * width_ + x]; }

  int columns_, rows_, width_;
  bool closed_;
  std::vector<Vec3> points_;
};

}  // namespace curvefusion
