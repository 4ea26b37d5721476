#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "experiments/reproduction/verdict.h"
#include "experiments/studies/study.h"

namespace curvefusion {

/// What there is of a study in a folder.
struct StudyState {
  StudyRequest request;             ///< what was asked of it, see JudgeClaims
  int planned = 0;                  ///< runs that the request asks for
  StudyResults finished;            ///< those measured with the same settings, not failed
  std::set<std::string> revisions;  ///< of the program, that measured them
};

struct JudgedClaim {
  const Claim* claim = nullptr;
  std::vector<ClaimResult> results;
};

/// All claims held against the finished runs of a folder.
struct Reproduction {
  std::map<std::string, StudyState> studies;  ///< by name: those that test a claim
  std::vector<JudgedClaim> claims;
};

/// The studies that test a claim of the paper, in the order of AllStudies.
std::vector<Study> StudiesOfClaims();

/// Reads what the request asks for and the folder has; measures nothing. Of a study without any
/// finished run at full size the quick runs count, where there are some.
Reproduction JudgeClaims(const StudyRequest& request, const std::filesystem::path& folder);

}  // namespace curvefusion
