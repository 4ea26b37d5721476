// Which wires can a Kinect V1 scan? "thin structures of diameter smaller than 2 mm cannot be
// sufficiently scanned by the Kinect V1 for proper reconstruction", and a black model "cannot be
// scanned using Kinect V1 due to its light-absorbing surface"; models of "considerable surface
// shininess ... can still be scanned well" (CurveFusion 5, Effect of wire thickness and color).
#include <fmt/format.h>

#include <cmath>

#include "experiments/metrics/evaluation.h"
#include "experiments/metrics/truth.h"
#include "experiments/studies/bar_panels.h"
#include "experiments/studies/reconstruction_run.h"
#include "experiments/studies/result_table.h"
#include "experiments/studies/studies.h"
#include "graph/io/graph_io.h"

namespace curvefusion {

namespace {

constexpr FrameCounts kFrames = {100, 30};
constexpr int kWires[] = {1, 2, 3, 4};      // mm; of the object `triangles`
constexpr double kFound = 5 * kMillimetre;  // as F5

// Brightness and gloss as the simulator counts them (SceneOptions).
struct Finish {
  double albedo;
  double shininess;
};

// Greys from white to black, and a bright wire of which a fifth, two fifths and three of the light
// are mirrored: painted steel, chrome that is worn, chrome.
std::vector<Finish> FinishesOf(const StudyRequest& request) {
  if (request.quick) return {{0.9, 0}, {0.3, 0}, {0.05, 0}, {0.9, 0.4}};
  return {{0.9, 0}, {0.7, 0},  {0.5, 0},   {0.3, 0},   {0.2, 0},
          {0.1, 0}, {0.05, 0}, {0.9, 0.2}, {0.9, 0.4}, {0.9, 0.6}};
}

std::vector<StudyCase> Cases(const StudyRequest& request) {
  std::vector<StudyCase> cases;
  for (const Finish& finish : FinishesOf(request)) {
    for (const uint64_t seed : SeedsOf(request)) {
      SimulationOptions scan = ObjectScan(request, "triangles", seed, kFrames);
      scan.scene.wire_albedo = finish.albedo;
      scan.scene.wire_shininess = finish.shininess;
      scan.scene.wire_saturation = 0;
      for (const Profile profile : request.profiles) {
        cases.push_back({{{"albedo", fmt::format("{}", finish.albedo)},
                          {"shininess", fmt::format("{}", finish.shininess)},
                          {"profile", ProfileName(profile)}},
                         seed,
                         scan,
                         CaseConfig(request, profile)});
      }
    }
  }
  return cases;
}

std::vector<Vec3> Aligned(const SkeletonGraph& result, const RigidTransform& T_truth_result) {
  std::vector<Vec3> points = SampleSkeleton(result).positions;
  for (Vec3& point : points) point = T_truth_result * point;
  return points;
}

// Which share of the true wires of each diameter lies within 5 mm of the result.
void AddRecallOfWires(const SkeletonGraph& result, const SkeletonGraph& truth, Figures& figures) {
  const SkeletonSamples samples = SampleSkeleton(truth);
  const std::vector<Vec3> points = Aligned(result, Evaluate(result, nullptr, truth).T_truth_result);
  for (const int diameter_mm : kWires) {
    std::vector<Vec3> wire;
    for (size_t i = 0; i < samples.size(); ++i) {
      const bool is_it = std::lround(2 * samples.radii[i] / kMillimetre) == diameter_mm;
      if (is_it) wire.push_back(samples.positions[i]);
    }
    double found = 0;
    if (!points.empty()) {
      for (const double distance : DistancesTo(wire, points)) found += distance <= kFound ? 1 : 0;
    }
    figures[fmt::format("recall_of_{}mm", diameter_mm)] = found / static_cast<double>(wire.size());
  }
}

RunOutcome Run(const RunInput& input) {
  RunOutcome outcome = input.reconstruct(input);
  AddRecallOfWires(ReadSkeleton(input.folder / "skeleton.json"), ReadTruth(input.scan / "truth"),
                   outcome.figures);
  return outcome;
}

const std::vector<TableColumn> kColumns = {
    {"recall of 1 mm", "recall_of_1mm"},
    {"of 2 mm", "recall_of_2mm"},
    {"of 3 mm", "recall_of_3mm"},
    {"of 4 mm", "recall_of_4mm"},
    {"F2", "aligned.curves.2mm.f"},
    {"false length (m)", "aligned.curves.false_length"},
    {"diameter error (mm)", "aligned.diameter.mean_error_mm"},
    {"pieces (of 4)", "components", 0}};

void Report(const StudyResults& results) {
  WriteTable(results.folder, results.stem,
             MedianTable(GroupRuns(results.runs, {"albedo", "shininess", "profile"}), kColumns));
  std::vector<BarPanel> panels;
  for (const int diameter_mm : kWires) {
    panels.push_back({fmt::format("Recall of the wire of {} mm", diameter_mm),
                      fmt::format("recall_of_{}mm", diameter_mm)});
  }
  DrawBarPanels(results, {"albedo", "shininess"}, panels);
}

}  // namespace

Study ThicknessColourStudy() {
  return {"thickness-colour",
          "Triangles of 1, 2, 3 and 4 mm wire, white to black and shiny: which of them are found?",
          Cases, Run, Report};
}

}  // namespace curvefusion
