#pragma once

#include "graph/contraction/ridge_projection.h"

namespace curvefusion {

/// How the ridges are found by which bundles are registered (CarriedPoints): farther apart than
/// those of curves.
inline RidgeProjectionOptions ForBundles(RidgeProjectionOptions options) {
  constexpr double kBundleSpacing = 1.5;
  options.spacing *= kBundleSpacing;
  return options;
}

}  // namespace curvefusion
