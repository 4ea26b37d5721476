#pragma once

#include <string>
#include <vector>

#include "experiments/simulation/objects.h"

namespace curvefusion {

// Objects in which one thing varies, to see from where on a method fails, and the places at which
// it is measured: names that are numbers, ascending.

/// Upright wires side by side, one of each diameter.
std::vector<WireCurve> ThicknessRow();
std::vector<std::string> ThicknessPlaces();  ///< mm

/// Three wires of 5 mm that rise to 80 mm; their lowest point is to lie on the table.
std::vector<WireCurve> RisingWires();
std::vector<std::string> HeightPlaces();    ///< mm: middles of ranges of heights
std::string HeightPlace(double height_mm);  ///< the range that holds it; "" above all

/// Stars side by side, one of each number of arms of 5 mm.
std::vector<WireCurve> Stars();
std::vector<std::string> ValencePlaces();

/// Upright wires of 3, 6, 9 and 12 mm, and two that taper between 3 and 12 mm.
std::vector<WireCurve> MixedRadii();
std::vector<std::string> RadiusPlaces();  ///< mm

}  // namespace curvefusion
