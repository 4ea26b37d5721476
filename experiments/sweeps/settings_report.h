#pragma once

#include "experiments/studies/study.h"

namespace curvefusion {

/// Tables and figures of runs that differ in the label "setting", the default among them: STEM.md
/// and .tex with every headline figure and its ratio to the default; where `draws`, bars of the
/// changes (STEM.png, .pdf) and, where the settings are numbers of one key, curves over them
/// (STEM_curves). Changes are left out where there is no default or nothing else.
void ReportSettings(const StudyResults& results, bool draws);

}  // namespace curvefusion
