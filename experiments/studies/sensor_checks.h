#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace curvefusion {

/// What is measured of the simulator: a sensor before a wall, a sensor before thin wires, or the
/// poses of a source.
struct SensorMeasurement {
  enum class Kind { kWall, kWires, kPoses };
  Kind kind = Kind::kWall;
  std::string subject;     ///< one of SensorNames(), or of PoseSourceNames()
  double distance = 0;     ///< metres to the wall or the wires
  double diameter_mm = 0;  ///< of the wires; exact, as labels show it
  double albedo = 0.7;     ///< of the wires
  int frames = 0;          ///< length of the trajectories, at 30 frames a second
  bool filter = true;      ///< of structured light: BlockMatchingOptions::drop_small_components

  bool operator==(const SensorMeasurement&) const = default;
};

/// Figures of a measurement by name. Wall: `sigma_mm`, `bias_mm` (its amount), `valid`. Wires:
/// `recall`, `area_ratio`, `flying` (WireRecall). Poses: `ate_mm`, `rpe_mm`, `rpe_degree` (over 1
/// s), means over 20 trajectories around an object of 0.2 m. Throws Error(kUsage) for an unknown
/// subject.
std::map<std::string, double> MeasureSensor(const SensorMeasurement& measurement, uint64_t seed);

/// Where a band comes from: the model gives the figure without having been told it; a parameter was
/// fitted to it; or it is itself a parameter, so that the check is of the code alone.
enum class CheckBasis { kPredicted, kFitted, kParameter };
std::string BasisName(CheckBasis basis);

/// A figure and the band it has to lie in.
struct SensorCheck {
  SensorMeasurement measurement;
  std::string figure;
  double least = 0;
  double greatest = 0;
  CheckBasis basis = CheckBasis::kPredicted;
  std::string source;
};

/// Every check of the simulator's sensors and pose sources.
std::vector<SensorCheck> SensorChecks();

/// Distances in metres and diameters in mm at which the Kinect V1's recall of wires is tabulated.
const std::vector<double>& RecallDistances();
const std::vector<double>& RecallDiameters_mm();

/// The recall that the prototype of the model had at these places, by their indices. A figure to
/// compare with, not a truth.
double PrototypeRecall(size_t distance, size_t diameter);

/// Published noise of a Kinect V1 before a wall, metres: Khoshelham and Elberink 2012 (1.425 z^2
/// mm), Nguyen, Izadi and Lovell 2012 (1.2 + 1.9 (z - .4)^2 mm).
double KhoshelhamSigma(double distance);
double NguyenSigma(double distance);

/// The diameters in mm at which the recall of other sensors is measured, 0.7 m away.
const std::vector<double>& SensorDiameters_mm();

/// Everything to measure: what the checks need, the recall table, the recall of other sensors
/// against diameter, and pose errors against length; each once.
std::vector<SensorMeasurement> SensorMeasurements();

}  // namespace curvefusion
