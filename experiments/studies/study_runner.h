#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/studies/reconstruction_run.h"
#include "experiments/studies/study.h"

namespace curvefusion {

/// How a study is run.
struct RunnerOptions {
  int jobs = 1;            ///< scans that are worked on at the same time, each with all its cases
  bool remeasure = false;  ///< measure again what another revision of the program has measured
  /// Folders of sweeps and other studies, whose scans are taken over and added to.
  std::vector<std::filesystem::path> caches = {};
  /// RunInput::reconstruct; MeasurementByCells takes and leaves the cells of such folders.
  CaseMeasurement reconstruct = ReconstructAndEvaluate;
};

/// What is to do before any of it is done.
struct StudyPlan {
  std::vector<StudyCase> cases;
  int finished = 0;        ///< measured earlier with the same settings
  int other_settings = 0;  ///< measured earlier with other settings: they will be replaced
  int other_revision = 0;  ///< finished, but by another revision of the program
};

/// The cases a request gives and which of them are finished in `folder`. Throws Error(kUsage) for
/// two cases of one name, and for settings that cannot be.
StudyPlan PlanStudy(const Study& study, const StudyRequest& request,
                    const std::filesystem::path& folder);

/// What the names of a study's tables, figures and runs begin with: study, split and whether it is
/// quick, so that none is taken for another.
std::string StudyStem(const Study& study, const StudyRequest& request);

/// Where the files of a run are kept.
std::filesystem::path RunFolder(const Study& study, const StudyRequest& request,
                                const std::filesystem::path& folder, const StudyCase& study_case);

/// The runs that `folder` has of those a request asks for, in the order of the cases: measured with
/// the same settings, not failed. Measures nothing. Throws as PlanStudy.
StudyResults FinishedRuns(const Study& study, const StudyRequest& request,
                          const std::filesystem::path& folder);

/// Frames that a case measures. Chosen: data that it makes itself are as one.
int FramesOf(const StudyCase& study_case);

/// "table1, frames"
std::string StageOf(const Study& study);

/// Measures what is not finished yet, then writes the runs as CSV and JSON and calls the study's
/// report. Files: scans/KEY (simulated scans, shared by all studies in `folder`), runs/STEM/CASE/
/// (run.json and what the study keeps), STEM.csv, STEM.json, and what the report writes. A run
/// appears under its name only when it is complete, so that a second call goes on where the first
/// was interrupted. Runs that find nothing count; runs that fail are recorded with their message,
/// do not end the study and are tried again by the next call. `progress` counts frames that are
/// simulated or measured, as the stage StageOf; it may be called from several threads, one at a
/// time. Throws Error(kUsage) as PlanStudy, kInterrupted, and kResource before anything is measured
/// where there is a report and no gnuplot.
StudyResults RunStudy(const Study& study, const StudyRequest& request,
                      const std::filesystem::path& folder, const RunnerOptions& options,
                      const Progress& progress);

}  // namespace curvefusion
