// "As the accuracy and the depth resolution of the scanners increase, the thickness" of what can be
// reconstructed decreases (CurveFusion 5, Effect of different sensors).
#include <fmt/format.h>

#include <algorithm>

#include "experiments/studies/fine_scan.h"
#include "experiments/studies/gnuplot.h"
#include "experiments/studies/result_table.h"
#include "experiments/studies/studies.h"

namespace curvefusion {

namespace {

constexpr FrameCounts kFrames = {60, 30};
constexpr double kReconstructed = 0.9;  // chosen: nine tenths of the curves within 5 mm, both ways

std::vector<int> DiametersOf(const StudyRequest& request) {
  if (request.quick) return {8, 4};
  return {12, 8, 6, 5, 4, 3, 2};
}

void AddCases(const StudyRequest& request, const std::string& diameter,
              const SimulationOptions& scan, uint64_t seed, const Profile profile,
              std::vector<StudyCase>& cases) {
  cases.push_back(
      {{{"sensor", scan.sensor}, {"diameter", diameter}, {"profile", ProfileName(profile)}},
       seed,
       scan,
       ConfigOfScan(request, profile, scan)});
}

std::vector<StudyCase> Cases(const StudyRequest& request) {
  std::vector<StudyCase> cases;
  for (const uint64_t seed : SeedsOf(request)) {
    for (const Profile profile : request.profiles) {
      for (const char* sensor : {"kinect_v2", "sr300", "kinect_v1"}) {
        for (const int diameter_mm : DiametersOf(request)) {
          SimulationOptions scan = ObjectScan(request, "breadholder", seed, kFrames);
          scan.sensor = sensor;
          scan.object_options.wire_diameter = diameter_mm * kMillimetre;
          AddCases(request, fmt::format("{}", diameter_mm), scan, seed, profile, cases);
        }
      }
      AddCases(request, fmt::format("{}", kFineWire / kMillimetre),
               FineScan(request, seed, kFrames), seed, profile, cases);
    }
  }
  return cases;
}

RunOutcome Run(const RunInput& input) {
  RunOutcome outcome = input.reconstruct(input);
  const auto f = outcome.figures.find("aligned.curves.5mm.f");
  const bool is_there = f != outcome.figures.end() && f->second >= kReconstructed;
  outcome.figures["reconstructed"] = is_there ? 1 : 0;
  return outcome;
}

const std::vector<TableColumn> kColumns = {
    {"F5", "aligned.curves.5mm.f"},
    {"F2", "aligned.curves.2mm.f"},
    {"recall at 5 mm", "aligned.curves.5mm.recall"},
    {"false length (m)", "aligned.curves.false_length"},
    {"diameter error (mm)", "aligned.diameter.mean_error_mm"},
    {"reconstructed (share of seeds)", "reconstructed"}};

// F over the diameter, a curve a sensor and profile.
Plot FigureOf(const StudyResults& results) {
  const std::vector<RunGroup> points = GroupRuns(results.runs, {"sensor", "profile", "diameter"});
  std::string data, curves;
  int index = 0;
  for (const RunGroup& curve : GroupRuns(results.runs, {"sensor", "profile"})) {
    for (const RunGroup& point : points) {
      const bool is_on_curve =
          std::equal(curve.labels.begin(), curve.labels.end(), point.labels.begin());
      if (!is_on_curve) continue;
      data += LabelOf(point.labels, "diameter") + " " +
              SpreadData(SpreadOf(point, "aligned.curves.5mm.f")) + "\n";
    }
    data += "\n\n";
    const std::string profile = LabelOf(curve.labels, "profile");
    curves += fmt::format("{} data index {} using 1:2:3:4 with yerrorlines dt {} title '{}, {}'",
                          index == 0 ? "plot" : ",", index, profile == "best" ? 1 : 2,
                          LabelOf(curve.labels, "sensor"), profile);
    ++index;
  }
  return {data,
          "set datafile missing '?'\nset xlabel 'Diameter of the wires (mm)'\n"
          "set ylabel 'F at 5 mm, aligned'\nset xrange [1:12.5]\nset yrange [0:1.05]\n"
          "set key outside right noenhanced\n" +
              curves};
}

void Report(const StudyResults& results) {
  WriteTable(results.folder, results.stem,
             MedianTable(GroupRuns(results.runs, {"sensor", "diameter", "profile"}), kColumns));
  DrawPlot(results.folder, results.stem, FigureOf(results));
}

}  // namespace

Study LeastThicknessStudy() {
  return {"least-thickness",
          "Breadholder of 12 to 2 mm wire on Kinect V2, SR300 and Kinect V1, of 1.5 mm on an Artec "
          "Space Spider: how thin may wires be?",
          Cases, Run, Report};
}

}  // namespace curvefusion
