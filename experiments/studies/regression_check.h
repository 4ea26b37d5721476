#pragma once

#include <filesystem>

#include "experiments/studies/result_table.h"
#include "experiments/studies/study.h"

namespace curvefusion {

/// The runs of the same cases in `baseline`, the folder of an earlier call. Their configs may
/// differ: that is what one wants to compare. Throws Error(kBadInput) where the baseline lacks a
/// case, or has it of another scan.
std::vector<StudyRun> ReadBaseline(const Study& study, const StudyRequest& request,
                                   const std::filesystem::path& baseline);

struct RegressionCheck {
  Table table;        ///< every headline figure: before, now, their ratio and whether it fell
  bool fell = false;  ///< any did
};

/// Compares the runs of a study with earlier ones of the same cases, group by group of runs that
/// differ in object and seed only. A figure fell where it is worse than before by more than
/// `tolerance`, in its own unit (shares, millimetres), or has no value any more; what depends on
/// the machine is told but not judged.
RegressionCheck CompareWithBaseline(const std::vector<StudyRun>& before,
                                    const std::vector<StudyRun>& now, double tolerance);

}  // namespace curvefusion
