#pragma once

#include <string>

#include "graph/skeleton_graph.h"
#include "kernel/geometry.h"
#include "kernel/image.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// A direction to look at a skeleton from.
struct OrthographicView {
  std::string name;
  Mat3 R_view_world = Mat3::Identity();  ///< rows: right, up, towards the viewer
  bool scale_bar = true;
  double point_ink = 0;  ///< 0: points are pale, behind a graph; 1: black, where they stand alone
};

/// The box around a graph in a view's axes; empty for an empty graph.
Eigen::AlignedBox3d ViewBounds(const SkeletonGraph& graph, const Mat3& R_view_world);

/// Width and height (metres) of a graph seen in a view.
Vec2 ViewExtent(const SkeletonGraph& graph, const Mat3& R_view_world);

/// Draws the graph, its junctions and free ends over the points it was made from, nearer points
/// darker, with a scale bar; the middle of `bounds` (in the view's axes) in the middle of the
/// picture. `scale` is in pixels per metre.
ColorImage DrawFramedView(const SkeletonGraph& graph, const ObservedPoints& points,
                          const OrthographicView& view, const Eigen::AlignedBox3d& bounds,
                          int width, int height, double scale);

}  // namespace curvefusion
