#include "experiments/studies/fine_scan.h"

#include <cstring>
#include <variant>

#include "experiments/simulation/objects.h"
#include "kernel/options.h"

namespace curvefusion {

namespace {

constexpr const char* kObject = "small_breadholder";
constexpr double kWire = 5 * kMillimetre;  // of the breadholder (CurveFusion, figure of sensors)
constexpr double kScale = kFineWire / kWire;
// Metres: the near half of the scanner's .2 to .3 m, so that the far side of the object is in it.
constexpr double kStandoff = 0.22;

// Every length but the sensor's range.
class LengthScaler : public OptionVisitor {
 public:
  void BeginSection(const char*) override {}
  void Visit(const OptionInfo& info, double& value) override {
    const bool is_length = std::strcmp(info.unit, "m") == 0;
    if (is_length && std::strcmp(info.name, "max_depth") != 0) value *= kScale;
  }
  void Visit(const OptionInfo&, int&) override {}
  void Visit(const OptionInfo&, bool&) override {}
};

std::vector<WireCurve> SmallBreadholder() {
  std::vector<WireCurve> curves = MakeObject("breadholder").curves;
  for (WireCurve& curve : curves) {
    for (Vec3& point : curve.points) point *= kScale;
    curve.diameter = kFineWire;
  }
  return curves;
}

}  // namespace

SimulationOptions FineScan(const StudyRequest& request, uint64_t seed, const FrameCounts& frames) {
  SimulationOptions scan = ObjectScan(request, kObject, seed, frames);
  scan.object_options.curves = SmallBreadholder();
  scan.sensor = "artec_spider";
  scan.pose_source = "true";
  scan.motion.standoff = kStandoff;
  return scan;
}

Config ConfigOfScan(const StudyRequest& request, Profile profile, const SimulationOptions& scan) {
  Config config = CaseConfig(request, profile);
  if (scan.object != kObject) return config;
  if (auto* paper = std::get_if<PaperOptions>(&config.pipeline)) {
    LengthScaler scaler;
    VisitOptions(*paper, scaler);
    paper->surfaces.keep_unrendered = true;
  }
  return config;
}

}  // namespace curvefusion
