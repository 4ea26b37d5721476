#include "experiments/studies/studies.h"

#include "kernel/error.h"
#include "kernel/options.h"

namespace curvefusion {

std::vector<Study> AllStudies() {
  return {ObjectsStudy(),         Table1Study(),         BundleSizeStudy(),
          SensorsStudy(),         LeastThicknessStudy(), PosesStudy(),
          ThicknessColourStudy(), RgbResolutionStudy(),  InterWireStudy(),
          LimitationsStudy(),     ComparisonsStudy(),    SensorValidationStudy(),
          AblationStudy(),        CheckStudy(),          FamiliesStudy()};
}

Study StudyNamed(const std::string& name) {
  std::vector<std::string> names;
  for (const Study& study : AllStudies()) {
    if (study.name == name) return study;
    names.push_back(study.name);
  }
  throw Error(ErrorKind::kUsage,
              "there is no study " + name + "; did you mean " + NearestName(name, names) + "?");
}

}  // namespace curvefusion
