#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/studies/result_table.h"
#include "experiments/studies/sensor_checks.h"

namespace curvefusion {

/// What tells a measurement of the study from others.
Labels LabelsOf(const SensorMeasurement& what);

/// What the study measured, found by its place.
class MeasuredSensors {
 public:
  /// Points into the results; they must outlive it.
  explicit MeasuredSensors(const StudyResults& results);

  std::optional<Spread> Find(const SensorMeasurement& what, const std::string& figure) const;

  /// "median least greatest" for gnuplot.
  std::string Data(const SensorMeasurement& what, const std::string& figure) const {
    return SpreadData(Find(what, figure));
  }

 private:
  std::vector<RunGroup> groups_;
};

}  // namespace curvefusion
