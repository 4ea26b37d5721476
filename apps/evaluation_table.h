#pragma once

#include <string>

#include "experiments/metrics/evaluation.h"

namespace curvefusion {

/// An evaluation as a table for people: figures raw, aligned, and of the main piece, aligned,
/// beside each other.
std::string EvaluationTable(const Evaluation& evaluation);

}  // namespace curvefusion
