#pragma once

#include <cstdint>

#include "fusion/curve_graph/selection.h"

namespace curvefusion {

/// How many points each rule of the segmentation took, CurveFusion 4.1: pixels of all frames that
/// were segmented, then points of all bundles.
struct PointFunnel {
  int64_t frames = 0;          ///< segmented
  int64_t depth_pixels = 0;    ///< with a depth
  int64_t thin_pixels = 0;     ///< of these not explained by large surfaces: in front of them
  int64_t gated_pixels = 0;    ///< of these kept by colours in wire arrays
  int64_t merged_points = 0;   ///< voxels of bundles with such pixels
  int64_t too_few_frames = 0;  ///< points dropped: seen in too few frames of their bundle
  int64_t small_clusters = 0;  ///< points dropped as ghosts: noise and small clusters
  int64_t unverified = 0;      ///< points dropped as ghosts: no colour edges where they end
  int64_t isolated = 0;        ///< points dropped as ghosts: far from all larger clusters
  int64_t points = 0;          ///< points that remain
  double chroma = 0;           ///< grey levels: mean of the largest less the least of R, G and B

  void Add(const PointFunnel& other);
};

/// How many metres of curve each rule took, after the segmentation.
struct CurveFunnel {
  double contracted = 0;     ///< first found in the points
  UnprovenLengths unproven;  ///< moved to the uncertain curves
  double looked_past = 0;    ///< dropped: colour images look past them
  double curves = 0;         ///< that remain
};

struct Funnel {
  PointFunnel points;
  CurveFunnel curves;
};

}  // namespace curvefusion
