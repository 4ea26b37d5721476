#pragma once

#include <string>
#include <vector>

#include "experiments/studies/study.h"

namespace curvefusion {

/// A panel of bars: one figure of all runs.
struct BarPanel {
  std::string title;
  std::string figure;
  double least_top = 1.05;  ///< where the axis ends unless a run has more; 1.05 fits shares
};

/// Draws results.folder/results.stem: panels in two columns, in each a group of bars for every
/// combination of the labels `rows` ("rack/sr300") with a bar a profile: the median over seeds and
/// a line from the least to the greatest value.
void DrawBarPanels(const StudyResults& results, const std::vector<std::string>& rows,
                   const std::vector<BarPanel>& panels);

}  // namespace curvefusion
