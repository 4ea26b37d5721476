#pragma once

#include <string>
#include <vector>

namespace curvefusion {

/// How far a result may be trusted. Shares are of the length of its curves.
struct Trust {
  double length = 0;          ///< metres
  double wire_length = 0;     ///< metres that are wire, by the probabilities of all curves
  double measured_share = 0;  ///< on edges with a measured diameter
  double depth_share = 0;     ///< seen in most of the depth images that looked there
  double colour_share = 0;    ///< near a strip that colour images show
  bool adjusted = false;      ///< whether curves and poses were adjusted to colours
  bool from_colour = false;   ///< whether the curves come from colour images alone
  double residual_before_px =
      0;                      ///< of curves in colour images, before the adjustment; 0 = unknown
  double residual_px = 0;     ///< after it; 0 = unknown
  double pose_shift = 0;      ///< metres: by which poses were moved, median over frames
  double max_pose_shift = 0;  ///< metres
  double pose_turn = 0;       ///< radians, median
  /// Radians: between the lines of sight to the curves' middle that differ most.
  double view_angle = 0;

  /// Whether anything is known: the paper does not judge its results.
  bool is_judged() const { return length > 0; }
};

/// Why the result cannot be trusted, a sentence each; empty where nothing speaks against it, or
/// where there is no result.
std::vector<std::string> Doubts(const Trust& trust);

/// What to know about where curves lie that could not be adjusted to colours; empty where they
/// were, or where there is no result. For results whose colour images were to be used.
std::string PlacesWarning(const Trust& trust);

/// What to know about curves that were seen from nearly one side; empty where they were not, or
/// where there is no result.
std::string ViewWarning(const Trust& trust);

}  // namespace curvefusion
