#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/studies/study.h"

namespace curvefusion {

/// What run.json holds: the run, and the settings it was measured with.
struct RunFile {
  StudyRun run;
  std::string settings;  ///< CaseSettings of its case
};

/// Writes folder/run.json: labels, seed, outcome, figures, settings, program and machine.
void WriteRunFile(const std::filesystem::path& folder, const RunFile& file);

/// Reads it back; none where there is no such file, or none that can be read.
std::optional<RunFile> ReadRunFile(const std::filesystem::path& folder);

/// Writes all runs as a CSV file, a row a run: labels, seed, outcome, message, revision, and every
/// figure that any run has.
void WriteRunsCsv(const std::filesystem::path& path, const std::vector<StudyRun>& runs);

/// Writes the same as a JSON array, an object a run.
void WriteRunsJson(const std::filesystem::path& path, const std::vector<StudyRun>& runs);

}  // namespace curvefusion
