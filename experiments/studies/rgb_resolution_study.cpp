// Does the resolution of colour matter? Of 640x480 and 1280x1024 the paper "observed no discernible
// difference in the output quality" (CurveFusion 5, Effect of different RGB resolutions).
#include "experiments/studies/bar_panels.h"
#include "experiments/studies/result_table.h"
#include "experiments/studies/studies.h"

namespace curvefusion {

namespace {

constexpr FrameCounts kFrames = {.quick = 30};

std::vector<StudyCase> Cases(const StudyRequest& request) {
  std::vector<StudyCase> cases;
  for (const char* object : {"cat", "deco"}) {
    for (const bool large : {false, true}) {
      for (const uint64_t seed : SeedsOf(request)) {
        SimulationOptions scan = ObjectScan(request, object, seed, kFrames);
        scan.large_color = large;
        for (const Profile profile : request.profiles) {
          cases.push_back({{{"object", object},
                            {"colour", large ? "1280x1024" : "640x480"},
                            {"profile", ProfileName(profile)}},
                           seed,
                           scan,
                           CaseConfig(request, profile)});
        }
      }
    }
  }
  return cases;
}

const std::vector<TableColumn> kColumns = {
    {"F5", "aligned.curves.5mm.f"},
    {"F2", "aligned.curves.2mm.f"},
    {"junction recall", "aligned.junctions_10mm.recall"},
    {"diameter error (mm)", "aligned.diameter.mean_error_mm"}};

void Report(const StudyResults& results) {
  WriteTable(results.folder, results.stem,
             MedianTable(GroupRuns(results.runs, {"object", "colour", "profile"}), kColumns));
  DrawBarPanels(results, {"object", "colour"},
                {{"F at 5 mm, aligned", "aligned.curves.5mm.f"},
                 {"F at 2 mm, aligned", "aligned.curves.2mm.f"},
                 {"Junction recall", "aligned.junctions_10mm.recall"},
                 {"Diameter error (mm)", "aligned.diameter.mean_error_mm"}});
}

}  // namespace

Study RgbResolutionStudy() {
  return {"rgb-resolution",
          "Cat and decoration with colour images of 640x480 and of 1280x1024",
          Cases,
          {},
          Report};
}

}  // namespace curvefusion
