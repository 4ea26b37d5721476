#include "tests/experiments/studies/tiny_objects.h"

#include "experiments/studies/studies.h"

namespace curvefusion {

Study TinyObjects() {
  Study study = ObjectsStudy();
  study.cases = [cases = study.cases](const StudyRequest& request) {
    std::vector<StudyCase> tiny = cases(request);
    for (StudyCase& study_case : tiny) {
      study_case.scan->sensor = "ideal";
      study_case.scan->pose_source = "true";
      study_case.scan->frames = 6;
    }
    return tiny;
  };
  study.report = {};
  return study;
}

}  // namespace curvefusion
