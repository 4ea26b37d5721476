#pragma once

#include <string>

#include "experiments/metrics/evaluation.h"

namespace curvefusion {

/// An evaluation as a table for people: raw and aligned figures beside each other, lengths in mm.
std::string EvaluationTable(const Evaluation& evaluation);

}  // namespace curvefusion
