#include "experiments/simulation/depth_sensor.h"

#include <functional>
#include <map>

#include "experiments/simulation/footprint_sensor.h"
#include "experiments/simulation/structured_light.h"
#include "experiments/simulation/time_of_flight.h"
#include "kernel/error.h"
#include "kernel/options.h"

namespace curvefusion {
namespace {

using Maker = std::function<std::unique_ptr<DepthSensor>(uint64_t seed,
                                                         const BlockMatchingOptions& matching)>;

Maker StructuredLight(double focal_length_px) {
  return [=](uint64_t seed, const BlockMatchingOptions& matching) {
    StructuredLightOptions options;
    options.matching = matching;
    options.camera.fx = options.camera.fy = focal_length_px;
    return std::make_unique<StructuredLightSensor>(options, seed);
  };
}

Maker TimeOfFlight(const TimeOfFlightOptions& options) {
  return [=](uint64_t seed, const BlockMatchingOptions&) {
    return std::make_unique<TimeOfFlightSensor>(options, seed);
  };
}

Maker Footprint(const FootprintSensorOptions& options) {
  return [=](uint64_t seed, const BlockMatchingOptions&) {
    return std::make_unique<FootprintSensor>(options, seed);
  };
}

const std::map<std::string, Maker>& Makers() {
  static const std::map<std::string, Maker> makers = {
      {"kinect_v1", StructuredLight(580)},
      {"primesense", StructuredLight(570)},
      {"kinect_v2", TimeOfFlight(TimeOfFlightOptions())},
      {"azure_kinect", TimeOfFlight(AzureKinect())},
      {"sr300", Footprint(RealSenseSr300())},
      {"d400", Footprint(RealSenseD400())},
      {"d455", Footprint(RealSenseD455())},
      {"phone", Footprint(PhoneLidar())},
      {"artec_spider", Footprint(ArtecSpider())},
      {"ideal", Footprint(IdealSensor())}};
  return makers;
}

}  // namespace

std::vector<std::string> SensorNames() {
  std::vector<std::string> names;
  for (const auto& [name, maker] : Makers()) names.push_back(name);
  return names;
}

std::unique_ptr<DepthSensor> MakeDepthSensor(const std::string& name, uint64_t seed,
                                             const BlockMatchingOptions& matching) {
  const auto found = Makers().find(name);
  if (found == Makers().end()) {
    throw Error(ErrorKind::kUsage, "no sensor is called '" + name + "'; did you mean '" +
                                       NearestName(name, SensorNames()) + "'?");
  }
  return found->second(seed, matching);
}

}  // namespace curvefusion
