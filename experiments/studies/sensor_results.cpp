#include "experiments/studies/sensor_results.h"

#include <fmt/format.h>

#include <algorithm>

namespace curvefusion {

Labels LabelsOf(const SensorMeasurement& what) {
  const auto number = [](double value) { return value > 0 ? fmt::format("{}", value) : ""; };
  const bool wires = what.kind == SensorMeasurement::Kind::kWires;
  return {{"target", what.kind == SensorMeasurement::Kind::kWall ? "wall"
                     : wires                                     ? "wires"
                                                                 : "poses"},
          {"subject", what.subject},
          {"distance_m", number(what.distance)},
          {"diameter_mm", number(what.diameter_mm)},
          {"albedo", wires ? number(what.albedo) : ""},
          {"filter", what.filter ? "" : "off"},
          {"frames", number(what.frames)},
          {"folder", ""}};
}

MeasuredSensors::MeasuredSensors(const StudyResults& results)
    : groups_(GroupRuns(results.runs, {"target", "subject", "distance_m", "diameter_mm", "albedo",
                                       "filter", "frames", "folder"})) {}

std::optional<Spread> MeasuredSensors::Find(const SensorMeasurement& what,
                                            const std::string& figure) const {
  const Labels labels = LabelsOf(what);
  const auto group = std::find_if(groups_.begin(), groups_.end(),
                                  [&](const RunGroup& known) { return known.labels == labels; });
  return group == groups_.end() ? std::nullopt : SpreadOf(*group, figure);
}

}  // namespace curvefusion
