#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "experiments/metrics/evaluation.h"

namespace curvefusion {

/// What an evaluation is of, to tell rows apart.
struct EvaluationLabels {
  std::string result;
  std::string truth;
};

/// All figures as a JSON object: lengths in mm where the key ends in `_mm`, otherwise in metres;
/// null where there is nothing to take a share or a mean of.
std::string EvaluationText(const EvaluationLabels& labels, const Evaluation& evaluation);

/// EvaluationText into a file, atomically.
void WriteEvaluation(const std::filesystem::path& path, const EvaluationLabels& labels,
                     const Evaluation& evaluation);

/// Adds all figures but those of single edges as a row to a CSV file, which is made with a header
/// where it is missing; the columns are the keys of the JSON joined by dots. Throws
/// Error(kBadInput) where the file has other columns, Error(kResource) where it cannot be written.
void AppendEvaluation(const std::filesystem::path& path, const EvaluationLabels& labels,
                      const Evaluation& evaluation);

/// The figures of that row by the names of their columns, without those that have no value.
std::map<std::string, double> EvaluationFigures(const Evaluation& evaluation);

}  // namespace curvefusion
