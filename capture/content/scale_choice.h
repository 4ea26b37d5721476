#pragma once

#include <string>

namespace curvefusion {

/// What is known where translations times a factor fit the depth, or depth divided by it the
/// translations: both explain all images alike.
struct ScaleEvidence {
  double factor = 1;        ///< of the translations
  double depth_scale = 0;   ///< units per metre as given
  double median_depth = 0;  ///< metres, as given
  double speed = 0;         ///< metres per second as given; 0 = unknown
};

/// Which of both it is.
struct ScaleChoice {
  bool is_depth = false;
  double value = 1;                ///< the right depth_scale, or the factor of the translations
  double other = 1;                ///< what it would be were it the other one
  bool other_is_possible = false;  ///< with as plausible distances
};

/// Decides by what is plausible: a median depth in the reach of sensors (.3 to 5 m), units that are
/// customary, a speed that a hand can have. Values near a customary one become it.
ScaleChoice ChooseScale(const ScaleEvidence& evidence);

/// "metres are written as millimetres" and the like; empty for factors that are no customary unit.
std::string UnitOfFactor(double factor);

}  // namespace curvefusion
