#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/reproduction/claim.h"

namespace curvefusion {

enum class Verdict { kReproduced, kExceeded, kNotReproduced, kNotMeasured };
std::string VerdictName(Verdict verdict);

/// A claim held against the runs of one subject.
struct ClaimResult {
  std::string subject;  ///< a profile or a method
  Verdict verdict = Verdict::kNotMeasured;
  std::optional<Spread> figure = {};  ///< median and ends over seeds; none where not measured
  int seeds = 0;
  bool on_every_seed = true;  ///< false: some seed alone would give another verdict
};

/// The runs of a study that a claim about a profile or a method looks at: those with that label
/// `profile` or `method`; all where the study has neither. Failed runs are left out.
std::vector<StudyRun> RunsOf(const std::vector<StudyRun>& runs, const std::string& subject);

/// What a figure says of a claim.
Verdict VerdictOn(const Claim& claim, double figure);

/// A result for each subject of the claim, judged by the median over seeds. `runs` are those of its
/// study; a claim without study is not measured.
std::vector<ClaimResult> Judge(const Claim& claim, const std::vector<StudyRun>& runs);

}  // namespace curvefusion
