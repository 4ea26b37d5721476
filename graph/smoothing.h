#pragma once

#include <array>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Curve fitting of CurveFusion 4.3, Eq. 1.
struct SmoothingOptions {
  double step = 1 * kMillimetre;  ///< distance of vertices on curves (CurveFusion 4.3)
  double lambda = 60;             ///< weight of smoothness against data (CurveFusion 4.3)
  /// Free ends keep their place, which Eq. 1 smooths like any vertex: repeated smoothing would wear
  /// curved ends off.
  bool hold_free_ends = true;
  /// Radians, 0 to pi: bends sharper than this stay sharp; pi rounds all off as Eq. 1 does.
  double corner_angle = 1.0;
  /// Smooths what smoothing took away and adds it again (Tukey's twicing): bends shrink less.
  bool keep_curvature = true;
};

/// Of three vertices in a row, as Eq. 1 has it. Derived.
inline constexpr std::array<double, 3> kSecondDifference = {1, -2, 1};

/// Eq. 1 and nothing else.
SmoothingOptions PaperSmoothingOptions();

/// Resamples every edge to `step` and minimises over all vertices at once
///   sum |v_k - v0_k|^2 + lambda sum |v_(k-1) - 2 v_k + v_(k+1)|^2,
/// both sums over each edge; junctions are shared, so their first term counts once per incident
/// edge. Nodes of degree 2 count as points inside a curve, so a closed curve is smooth all around.
/// With keep_curvature what smoothing took away is smoothed and added again (Tukey's twicing): a
/// curve's shape shrinks by the square of what it would, while noise of a few steps still goes.
/// Throws Error(kBadInput) for more than a million steps.
/// Radii and observations are interpolated, not smoothed. One sparse factorisation: nearly linear
/// in vertices.
SkeletonGraph SmoothGraph(const SkeletonGraph& graph, const SmoothingOptions& options);

}  // namespace curvefusion
