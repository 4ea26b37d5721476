#pragma once

#include <optional>
#include <vector>

#include "experiments/studies/result_table.h"
#include "experiments/studies/study.h"

namespace curvefusion {

/// Of some runs' values of a figure: the middle, the mean, and the mean of the worst tenth of them
/// (at least of one).
struct Summary {
  double median = 0;
  double mean = 0;
  double worst_tenth = 0;
};

/// None for no values. `more_is_better` says which tenth is the worst.
std::optional<Summary> SummaryOf(std::vector<double> values, bool more_is_better);

/// Of how many results the program itself says not to trust them ("doubted"), by how good they are.
/// Runs without that figure, as of the paper's method, which is not judged, do not count.
Table TrustTable(const std::vector<StudyRun>& runs);

/// The tables of the study `families`: STEM.md by family, STEM_contrast.md, STEM_sensor.md and
/// STEM_all.md (families with wires together), in each figure "median / mean / worst tenth";
/// STEM_trust.md, that of TrustTable; STEM_worst.md with the six runs of the least F at 2 mm;
/// STEM.png with every run's F at 2 mm and false length by family; STEM_worst.png with the truth
/// and the result of the six.
void ReportFamilies(const StudyResults& results);

}  // namespace curvefusion
