#pragma once

#include <cstdint>
#include <functional>

#include "fusion/curve_graph/strip_views.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// Which places are wanted.
enum class CandidatePlaces {
  kFree,  ///< only those behind which depth shows something farther
  kAll,
};

/// How places are sought.
struct CandidateOptions {
  CandidatePlaces places = CandidatePlaces::kAll;
  /// Two places of one line of sight are one also where they lie no more pixels apart in the image
  /// in which they do most: short paths know no better.
  double same_place_px = 0;
  /// Strips are followed from places found, to such as are about as far away.
  bool follow = false;
  /// Lines of sight, evenly thinned. Chosen on the four shared scans without depth, between numbers
  /// that 15 training scans do not tell apart (docs/lab_notebook.md).
  size_t max_rays = 5000;
  /// Of the images that lines of sight start in, at least so many must have a place near each
  /// place: a share.
  double min_support = 0;
};

/// Measured: lines of sight to wires that depth has lost, and to those of a scan from colour alone
/// of which 5,000 give no curves: too few places lie on each (docs/lab_notebook.md).
inline constexpr size_t kManyRays = 20000;

/// Places of wires that the colour images show and no curve explains: thin wires that depth loses.
/// In some images, pixels in the middle of strips are followed along their lines of sight; a place
/// counts where nearly all images that look at it show the middle of a strip there as well. Nothing
/// for a line of sight on which two places do so, or many in a row, as along wires that the camera
/// moves along. Counts are those of the images that agree. Costs about 30 ns for each followed
/// pixel, depth and view. `on_progress` is called by the caller's thread; its exceptions pass
/// through.
ObservedPoints FindColourCandidates(
    const StripViews& views, const CandidateOptions& options,
    const std::function<void(int64_t done, int64_t total)>& on_progress);

}  // namespace curvefusion
