// Which sensors are good enough? A PrimeSense is comparable to a Kinect V1, with an SR300 the rack
// of 8 mm can be reconstructed and the breadholder of 5 mm cannot, and a Kinect V2 "cannot be used
// for producing any reasonable reconstruction results" (CurveFusion 5, Effect of different
// sensors).
#include "experiments/studies/bar_panels.h"
#include "experiments/studies/result_table.h"
#include "experiments/studies/studies.h"

namespace curvefusion {

namespace {

constexpr int kQuickFrames = 30;  // one bundle of the paper

struct Model {
  const char* object;
  double diameter;
};
// The diameters that the paper's figure of the sensors gives.
constexpr Model kModels[] = {{"breadholder", 5 * kMillimetre}, {"rack", 8 * kMillimetre}};

std::vector<StudyCase> Cases(const StudyRequest& request) {
  std::vector<StudyCase> cases;
  for (const Model& model : kModels) {
    for (const char* sensor : {"kinect_v1", "primesense", "sr300", "kinect_v2"}) {
      for (const uint64_t seed : SeedsOf(request)) {
        SimulationOptions scan = ObjectScan(request, model.object, seed);
        if (request.quick) scan.frames = kQuickFrames;
        scan.sensor = sensor;
        scan.object_options.wire_diameter = model.diameter;
        for (const Profile profile : request.profiles) {
          cases.push_back(
              {{{"object", model.object}, {"sensor", sensor}, {"profile", ProfileName(profile)}},
               seed,
               scan,
               CaseConfig(request, profile)});
        }
      }
    }
  }
  return cases;
}

const std::vector<TableColumn> kColumns = {{"F2", "aligned.curves.2mm.f"},
                                           {"recall at 5 mm", "aligned.curves.5mm.recall"},
                                           {"precision at 5 mm", "aligned.curves.5mm.precision"},
                                           {"false length (m)", "aligned.curves.false_length"},
                                           {"pieces", "components", 0}};

void Report(const StudyResults& results) {
  WriteTable(results.folder, results.stem,
             MedianTable(GroupRuns(results.runs, {"object", "sensor", "profile"}), kColumns));
  DrawBarPanels(results, {"object", "sensor"},
                {{"F at 2 mm, aligned", "aligned.curves.2mm.f"},
                 {"Recall at 5 mm", "aligned.curves.5mm.recall"},
                 {"Precision at 5 mm", "aligned.curves.5mm.precision"},
                 {"Pieces (truth: 1)", "components"}});
}

}  // namespace

Study SensorsStudy() {
  return {"sensors",
          "Breadholder (5 mm) and rack (8 mm) on Kinect V1, PrimeSense, SR300 and Kinect V2",
          Cases,
          {},
          Report};
}

}  // namespace curvefusion
