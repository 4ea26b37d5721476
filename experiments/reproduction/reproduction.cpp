#include "experiments/reproduction/reproduction.h"

#include <algorithm>

#include "experiments/studies/studies.h"
#include "experiments/studies/study_runner.h"

namespace curvefusion {

namespace {

StudyState StateOf(const Study& study, const StudyRequest& request,
                   const std::filesystem::path& folder) {
  StudyState state;
  state.request = request;
  state.planned = static_cast<int>(PlanStudy(study, request, folder).cases.size());
  state.finished = FinishedRuns(study, request, folder);
  for (const StudyRun& run : state.finished.runs) state.revisions.insert(run.revision);
  return state;
}

StudyState FullOrQuickState(const Study& study, const StudyRequest& request,
                            const std::filesystem::path& folder) {
  StudyState state = StateOf(study, request, folder);
  if (!state.finished.runs.empty() || request.quick) return state;
  StudyRequest quick = request;
  quick.quick = true;
  StudyState quick_state = StateOf(study, quick, folder);
  return quick_state.finished.runs.empty() ? state : quick_state;
}

}  // namespace

std::vector<Study> StudiesOfClaims() {
  std::vector<Study> studies = AllStudies();
  std::erase_if(studies, [](const Study& study) {
    return std::none_of(Claims().begin(), Claims().end(),
                        [&](const Claim& claim) { return claim.study == study.name; });
  });
  return studies;
}

Reproduction JudgeClaims(const StudyRequest& request, const std::filesystem::path& folder) {
  Reproduction reproduction;
  for (const Study& study : StudiesOfClaims()) {
    reproduction.studies[study.name] = FullOrQuickState(study, request, folder);
  }
  for (const Claim& claim : Claims()) {
    const auto study = reproduction.studies.find(claim.study);
    const bool is_tested = study != reproduction.studies.end();
    reproduction.claims.push_back(
        {&claim, Judge(claim, is_tested ? study->second.finished.runs : std::vector<StudyRun>())});
  }
  return reproduction;
}

}  // namespace curvefusion
