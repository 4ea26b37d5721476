#pragma once

#include <vector>

#include "fusion/appearance/wire_posterior.h"
#include "fusion/strips/strip_samples.h"

namespace curvefusion {

/// Where the strip of a curve sample was found.
struct TrackedStrip {
  int sample = 0;         ///< in the samples given
  double offset_px = 0;   ///< of its centre from the projected curve along the sample's normal
  double width_px = 0;    ///< the best of those tried
  double score = 0;       ///< posterior inside minus that of the less different side, -1 to 1
  bool accepted = false;  ///< clear enough to be a measurement
};

/// How strips, and single edges of theirs, are told from the background beside them.
struct StripContrast {
  // Chosen: half a pixel, as places are refined later; scores go up to 1, and what has a rival is
  // no measurement.
  static constexpr double kStepPx = 0.5;  ///< between the places that are tried
  static constexpr double kGuardPx = 1;   ///< blurred edge between strip and background
  static constexpr double kSidePx = 4;    ///< of background compared on either side
  static constexpr double kMinScore = 0.35;
  static constexpr double kMaxSecond = 0.7;                            ///< of the best score
  static constexpr int kGuard = static_cast<int>(kGuardPx / kStepPx);  ///< steps
  static constexpr int kSide = static_cast<int>(kSidePx / kStepPx);    ///< likewise
};

/// Whether another curve `clearance_px` away leaves enough background beside a strip.
bool IsClear(double clearance_px, double width_px);

/// Follows the strips of curves through one image: per sample, how well strips of several widths
/// around `2 radius / metres_per_px` and of every centre within +-search_px (steps of half a pixel)
/// stand out from both sides; then per run of samples along one edge the best sequence of centres
/// that do not jump (Viterbi). What lies nearer to another curve than to this one is left to that:
/// wires of a row look all the same. `samples` must be in order along their edges, `radii` holds
/// one value per sample. Not accepted are strips that stand out too little, those with a second
/// centre nearly as good, and those with another curve within .85 widths + 2 px, of which nothing
/// else is told.
std::vector<TrackedStrip> TrackStrips(const PosteriorImage& posterior,
                                      const std::vector<ProjectedSample>& samples,
                                      const std::vector<double>& radii, double search_px);

}  // namespace curvefusion
