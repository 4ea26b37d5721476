// Random scans of every family of objects and rooms (experiments/simulation/families): how far does
// what was chosen on a few objects carry?
#include <fmt/format.h>

#include <algorithm>

#include "experiments/metrics/truth.h"
#include "experiments/pictures/orthographic_view.h"
#include "experiments/pictures/png.h"
#include "experiments/simulation/families/scan_draw.h"
#include "experiments/studies/families_report.h"
#include "experiments/studies/reconstruction_run.h"
#include "experiments/studies/recordings.h"
#include "experiments/studies/studies.h"
#include "graph/io/graph_io.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

constexpr int kPicture = 360;          // pixels
constexpr double kFilled = 0.9;        // of a picture by the true object
constexpr double kLowContrast = 0.12;  // chosen: a white wire before a middling grey wall is at .3,
constexpr double kHighContrast = 0.3;  // one as different from it as wood from cardboard at .1

std::string ContrastName(const SimulationOptions& scan) {
  const Scene scene =
      MakeScene(MakeObject(scan.object, scan.object_options), scan.scene, scan.seed);
  if (scene.object.curves.empty()) return "none";
  const double contrast = ColorContrast(scene);
  if (contrast < kLowContrast) return "low";
  return contrast < kHighContrast ? "middling" : "high";
}

void AddSimulatedCases(const StudyRequest& request, std::vector<StudyCase>& cases) {
  for (const std::string& family : FamiliesOf(request)) {
    for (const uint64_t seed : SeedsOf(request)) {
      const SimulationOptions scan = FamilyScan(request, family, seed);
      const std::string contrast = ContrastName(scan);
      for (const Profile profile : request.profiles) {
        const Labels labels = {{"family", family},
                               {"contrast", contrast},
                               {"sensor", scan.sensor},
                               {"profile", ProfileName(profile)}};
        cases.push_back({labels, seed, scan, CaseConfig(request, profile), {}});
      }
    }
  }
}

void AddRecordings(const StudyRequest& request, std::vector<StudyCase>& cases) {
  for (const fs::path& recording : RecordingsOf(request)) {
    for (const Profile profile : request.profiles) {
      const Labels labels = {{"family", "recording " + recording.filename().string()},
                             {"contrast", "recording"},
                             {"sensor", "recording"},
                             {"profile", ProfileName(profile)}};
      cases.push_back({labels, 0, {}, CaseConfig(request, profile), recording});
    }
  }
}

std::vector<StudyCase> Cases(const StudyRequest& request) {
  std::vector<StudyCase> cases;
  AddSimulatedCases(request, cases);
  AddRecordings(request, cases);
  return cases;
}

// Truth and result from the side of -y and a little from above, framed by the truth.
void DrawPictures(const SkeletonGraph& truth, const fs::path& folder) {
  if (truth.empty()) return;
  Mat3 front;
  front << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  OrthographicView view;
  view.R_view_world = Eigen::AngleAxisd(0.3, Vec3::UnitX()).toRotationMatrix() * front;
  const Eigen::AlignedBox3d bounds = ViewBounds(truth, view.R_view_world);
  const double scale = kFilled * kPicture / bounds.sizes().head<2>().maxCoeff();
  const auto draw = [&](const SkeletonGraph& graph, const char* name) {
    WritePng(folder / name, DrawFramedView(graph, {}, view, bounds, kPicture, kPicture, scale));
  };
  draw(truth, "truth.png");
  draw(ReadSkeleton(folder / "skeleton.json"), "result.png");
}

// What pools over runs: a result without curves is worth nothing, and each run has its cycles right
// or not.
void AddPooledFigures(Figures& figures) {
  const auto value = [&](const char* name) {
    const auto found = figures.find(name);
    return found == figures.end() ? 0.0 : found->second;
  };
  if (value("true_length") == 0) return;
  for (const char* f : {"aligned.curves.1mm.f", "aligned.curves.2mm.f", "aligned.curves.5mm.f"}) {
    figures.emplace(f, 0);
  }
  figures["cycles_exact"] = value("cycles") == value("true_cycles") ? 1 : 0;
}

RunOutcome Run(const RunInput& input) {
  const fs::path& recording = input.study_case.recording;
  const fs::path& scan = recording.empty() ? input.scan : recording;
  RunOutcome outcome = input.reconstruct({input.study_case, scan, input.folder, input.progress});
  const std::optional<fs::path> truth = TruthOf(scan);
  if (!truth) return outcome;
  AddPooledFigures(outcome.figures);
  DrawPictures(ReadTruth(*truth), input.folder);
  return outcome;
}

}  // namespace

Study FamiliesStudy() {
  return {"families",
          "Random scans of every family of objects and rooms, and recordings that are named", Cases,
          Run, ReportFamilies};
}

}  // namespace curvefusion
