#pragma once

#include <vector>

#include "experiments/studies/result_table.h"
#include "experiments/studies/study.h"

namespace curvefusion {

/// The cases that compare simulated recordings with real ones: a furnished desk seen as one scans,
/// the same without the filter of small components and with raw colour, a room seen from farther
/// away; and each folder of StudyRequest::scans.
std::vector<StudyCase> RecordingCases(const StudyRequest& request);

/// Whether a case is one of these.
bool IsRecording(const StudyCase& study_case);

/// What the recording of such a case shows (recording_figures.h).
RunOutcome MeasureRecording(const RunInput& input);

/// Each figure: of real recordings, the band for the simulated one, both with and without the
/// filter where it matters, and of the folders given.
Table RecordingTable(const StudyResults& results);

}  // namespace curvefusion
