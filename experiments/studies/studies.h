#pragma once

#include <string>
#include <vector>

#include "experiments/studies/study.h"

namespace curvefusion {

/// Every study: those of the paper in its order, then those of the method's settings.
std::vector<Study> AllStudies();

/// The study of that name. Throws Error(kUsage) naming the nearest one.
Study StudyNamed(const std::string& name);

// One file each.
Study ObjectsStudy();
Study Table1Study();
Study BundleSizeStudy();
Study SensorsStudy();
Study LeastThicknessStudy();
Study PosesStudy();
Study ThicknessColourStudy();
Study RgbResolutionStudy();
Study InterWireStudy();
Study LimitationsStudy();
Study ComparisonsStudy();
Study SensorValidationStudy();
Study AblationStudy();
Study CheckStudy();
Study FamiliesStudy();

}  // namespace curvefusion
