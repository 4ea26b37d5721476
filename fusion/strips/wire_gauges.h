#pragma once

#include <vector>

namespace curvefusion {

/// The diameter measured of one wire, or that which several wires share.
struct MeasuredDiameter {
  static constexpr int kEnoughStrips = 20;  ///< chosen: fewer tell no diameter apart from others

  double diameter = 0;  ///< metres
  int strips = 0;       ///< that agree on it
};

/// The gauges of wire that an object is made of, thinnest first: groups of wires whose diameters
/// lie within a fifth of that of their best measured one, with at least 20 strips together. A
/// gauge's diameter is the median of its wires', weighted by strips.
std::vector<MeasuredDiameter> FindGauges(std::vector<MeasuredDiameter> wires);

/// The diameter of a wire, shrunk towards that of its gauge with the weight of `gauge_strips`
/// strips. A wire of fewer than 20 strips that fits no gauge is given the nearest; `wire` itself
/// where there are none.
double DrawnToGauge(const MeasuredDiameter& wire, const std::vector<MeasuredDiameter>& gauges,
                    double gauge_strips);

}  // namespace curvefusion
