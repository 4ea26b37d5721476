#pragma once

#include <string>

#include "experiments/studies/study.h"

namespace curvefusion {

/// Every setting that decides the outcome of a case as JSON, one text for the same case.
std::string CaseSettings(const StudyCase& study_case);

/// A name for settings: 16 hexadecimal digits of their FNV-1a hash.
std::string SettingsKey(const std::string& settings);

}  // namespace curvefusion
