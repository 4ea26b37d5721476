#pragma once

#include <optional>

#include "graph/contraction/ridge_skeleton.h"
#include "graph/skeleton_graph.h"
#include "kernel/geometry.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// The space in which points are contracted: the world's, or one in which arrays of close wires are
/// magnified or noise along the viewing rays is compressed.
struct ContractionSpace {
  double magnification = 1;    ///< of arrays of close wires
  double ray_noise_ratio = 1;  ///< of noise along the viewing rays to that across them

  bool IsWorld() const { return ray_noise_ratio <= 1 && magnification <= 1; }
  AffineTransform T_space_world(const ObservedPoints& points) const;
};

/// The curves of points of the world. `ridge` holds the ridges of the points where they are known
/// already; it is of use in the world's own space only.
SkeletonGraph ContractIn(const ContractionSpace& space, const ObservedPoints& points,
                         const std::optional<RidgePoints>& ridge, const RidgeOptions& options);

}  // namespace curvefusion
