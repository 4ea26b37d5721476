#include "fusion/wire_gauges.h"

#include <algorithm>
#include <cmath>

namespace curvefusion {

namespace {

constexpr double kTolerance = 0.2;  // relative: wires of one gauge, measured badly
constexpr int kEnoughStrips = 20;

bool IsLike(double diameter, double gauge) {
  return std::abs(diameter - gauge) <= kTolerance * gauge;
}

// Of at least one wire.
MeasuredDiameter WeightedMedian(std::vector<MeasuredDiameter> wires) {
  std::sort(wires.begin(), wires.end(),
            [](const auto& a, const auto& b) { return a.diameter < b.diameter; });
  MeasuredDiameter median;
  for (const MeasuredDiameter& wire : wires) median.strips += wire.strips;
  int passed = 0;
  for (const MeasuredDiameter& wire : wires) {
    median.diameter = wire.diameter;
    passed += wire.strips;
    if (2 * passed >= median.strips) break;
  }
  return median;
}

}  // namespace

std::vector<MeasuredDiameter> FindGauges(std::vector<MeasuredDiameter> wires) {
  std::sort(wires.begin(), wires.end(), [](const auto& a, const auto& b) {
    return a.strips != b.strips ? a.strips > b.strips : a.diameter < b.diameter;
  });
  std::vector<std::vector<MeasuredDiameter>> groups;
  for (const MeasuredDiameter& wire : wires) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& members) {
      return IsLike(wire.diameter, members.front().diameter);
    });
    if (group == groups.end()) {
      groups.push_back({wire});
    } else {
      group->push_back(wire);
    }
  }
  std::vector<MeasuredDiameter> gauges;
  for (const auto& group : groups) gauges.push_back(WeightedMedian(group));
  std::erase_if(gauges, [](const MeasuredDiameter& gauge) { return gauge.strips < kEnoughStrips; });
  std::sort(gauges.begin(), gauges.end(),
            [](const auto& a, const auto& b) { return a.diameter < b.diameter; });
  return gauges;
}

double DrawnToGauge(const MeasuredDiameter& wire, const std::vector<MeasuredDiameter>& gauges,
                    double gauge_strips) {
  const auto nearest =
      std::min_element(gauges.begin(), gauges.end(), [&](const auto& a, const auto& b) {
        return std::abs(a.diameter - wire.diameter) < std::abs(b.diameter - wire.diameter);
      });
  if (nearest == gauges.end()) return wire.diameter;
  if (IsLike(wire.diameter, nearest->diameter)) {
    const double own = wire.strips;
    return (own * wire.diameter + gauge_strips * nearest->diameter) / (own + gauge_strips);
  }
  return wire.strips < kEnoughStrips ? nearest->diameter : wire.diameter;
}

}  // namespace curvefusion
