#pragma once

#include "kernel/image.h"
#include "kernel/options.h"

namespace curvefusion {

/// Which raw depth pixels belong to a thin structure, CurveFusion 4.1 "Removing large surfaces".
struct DifferenceSetOptions {
  double front_distance = 0.0;
  double silhouette_margin_px = 0;
  bool accept_where_nothing_rendered = true;
  int min_neighbours = 0;
  double min_depth = 0.2;
  double max_depth = 3.0;
};
void VisitOptions(DifferenceSetOptions& options, OptionVisitor& visitor);

/// The image difference set: 1 where a raw depth pixel lies in front of what is left of the
/// volume's rendering after opening, or where nothing is left of it. `rendering` and `kept` (the
/// rendering after opening) may be smaller than `depth` by an integer factor; depth in metres, 0 =
/// none.
MaskImage ImageDifferenceSet(const DepthImage& depth, const DepthImage& rendering,
                             const DepthImage& kept, const DifferenceSetOptions& options);

}  // namespace curvefusion
