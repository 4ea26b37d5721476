#pragma once

#include <string>
#include <vector>

#include "experiments/studies/study.h"

namespace curvefusion {

/// Every study, in the order in which the paper has them.
std::vector<Study> AllStudies();

/// The study of that name. Throws Error(kUsage) naming the nearest one.
Study StudyNamed(const std::string& name);

// One file each.
Study ObjectsStudy();
Study BundleSizeStudy();
Study InterWireStudy();
Study SensorValidationStudy();

}  // namespace curvefusion
