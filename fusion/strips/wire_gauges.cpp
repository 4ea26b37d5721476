#include "fusion/strips/wire_gauges.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr double kTolerance = 0.2;  // chosen: relative; wires of one gauge, measured badly

bool IsLike(double diameter, double gauge) {
  return std::abs(diameter - gauge) <= kTolerance * gauge;
}

// Of at least one wire.
MeasuredDiameter GaugeOf(const std::vector<MeasuredDiameter>& wires) {
  MeasuredDiameter gauge;
  std::vector<std::pair<double, double>> diameters;
  for (const MeasuredDiameter& wire : wires) {
    gauge.strips += wire.strips;
    diameters.emplace_back(wire.diameter, wire.strips);
  }
  gauge.diameter = WeightedMedian(std::move(diameters));
  return gauge;
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
  for (const auto& group : groups) gauges.push_back(GaugeOf(group));
  std::erase_if(gauges, [](const MeasuredDiameter& gauge) {
    return gauge.strips < MeasuredDiameter::kEnoughStrips;
  });
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
  return wire.strips < MeasuredDiameter::kEnoughStrips ? nearest->diameter : wire.diameter;
}

}  // namespace curvefusion
