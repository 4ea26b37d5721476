#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fusion/strips/wire_color.h"

namespace curvefusion {

/// The background before which strips would vanish, which is the wires' colour. What a strip takes
/// away from its background, per pixel of its width, is the background less the wire's colour,
/// however blurred the image is: over strips before many backgrounds that is a straight line, and
/// the wires' colour is where it is zero.
struct VanishingColor {
  Eigen::Vector3d color;  ///< red, green, blue, grey levels
  double slope = 1;       ///< of the line; 1 where the strips' widths are right
  double error = 0;       ///< standard error of the slope
};

/// The vanishing colour of strips of about the same colour `about`; strips of one image are
/// compared with each other only, as exposures change. Strips off the line are left out. Nothing
/// with fewer than 40 strips or where backgrounds do not differ.
std::optional<VanishingColor> FindVanishingColor(const std::vector<ColoredStrip>& strips,
                                                 const WireColor& about);

/// The wires' colour as estimated from the colours of `strips`, shrunk towards their vanishing
/// colour: of narrow strips blur leaves too little to estimate it by. Wide strips tell their colour
/// better than their backgrounds do: what mirrors its surroundings vanishes before none.
WireColor DrawnToVanishing(const WireColor& estimated, const std::vector<ColoredStrip>& strips);

}  // namespace curvefusion
