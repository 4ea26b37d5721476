#pragma once

#include "kernel/image.h"

namespace curvefusion {

/// Pixels along the sides of a cell.
constexpr int kDepthCellPx = 4;

/// The greatest depth within each cell of an image: thin things in front hide nothing. 0 where
/// nothing is measured.
Image<float> FarthestInCells(const DepthImage& depth);

}  // namespace curvefusion
