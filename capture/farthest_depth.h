#pragma once

#include "kernel/image.h"

namespace curvefusion {

/// Pixels along the sides of a cell.
constexpr int kDepthCellPx = 4;

/// What lies so much farther than the depth before it is hidden, metres. Chosen: noise and drift of
/// depth come to less.
inline constexpr double kHidingDistance = 0.03;

/// The greatest depth within each cell of an image: thin things in front hide nothing. 0 where
/// nothing is measured.
Image<float> FarthestInCells(const DepthImage& depth);

}  // namespace curvefusion
