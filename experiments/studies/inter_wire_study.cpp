// How near may parallel wires be? "the skeleton extraction step works robustly for spacings larger
// than 17 mm" (CurveFusion 5, Effect of inter-wire distance).
#include <fmt/format.h>

#include "capture/sequence.h"
#include "experiments/metrics/evaluation_files.h"
#include "experiments/metrics/truth.h"
#include "experiments/studies/gnuplot.h"
#include "experiments/studies/reconstruction_run.h"
#include "experiments/studies/result_table.h"
#include "experiments/studies/studies.h"

namespace curvefusion {

namespace {

constexpr double kNearWires = 15 * kMillimetre;  // mean distance of a curve that is about a wire
constexpr double kResolvedF5 = 0.95;

std::vector<int> SpacingsOf(const StudyRequest& request) {
  if (request.quick) return {40, 18, 12};
  return {40, 30, 25, 22, 20, 18, 17, 16, 15, 12, 10, 8};
}

std::vector<StudyCase> Cases(const StudyRequest& request) {
  std::vector<StudyCase> cases;
  for (const int spacing_mm : SpacingsOf(request)) {
    for (const uint64_t seed : SeedsOf(request)) {
      SimulationOptions scan = ObjectScan(request, "parallel_wires", seed);
      scan.object_options.spacing = spacing_mm * kMillimetre;
      for (const Profile profile : request.profiles) {
        cases.push_back(
            {{{"spacing", std::to_string(spacing_mm)}, {"profile", ProfileName(profile)}},
             seed,
             scan,
             CaseConfig(request, profile)});
      }
    }
  }
  return cases;
}

double MeanDistance(const Polyline& curve, const std::vector<Vec3>& truth) {
  const std::vector<double> distances = DistancesTo(Resample(curve, kMillimetre), truth);
  return Mean(distances).value_or(0);
}

// What of a result is about the wires: the claim is not about false curves elsewhere in the room.
SkeletonGraph CurvesNearTruth(SkeletonGraph skeleton, const SkeletonGraph& truth) {
  const std::vector<Vec3> samples = SampleSkeleton(truth).positions;
  for (const EdgeId edge : skeleton.Edges()) {
    if (MeanDistance(skeleton.edge(edge).points, samples) > kNearWires) skeleton.RemoveEdge(edge);
  }
  skeleton.RemoveIsolatedNodes();
  return skeleton;
}

bool IsResolved(const Evaluation& evaluation) {
  const std::optional<double> f5 = evaluation.aligned.curves.within[2].F();
  return evaluation.topology.components == evaluation.topology.true_components &&
         f5.value_or(0) >= kResolvedF5;
}

RunOutcome Run(const RunInput& input) {
  const Sequence sequence = OpenSequence(input.scan);
  InterruptibleObserver observer(input.progress);
  const Reconstruction result = Reconstruct(sequence, input.study_case.config.pipeline, observer);
  RunOutcome outcome = EvaluateAndKeep(result.skeleton, input);
  const SkeletonGraph truth = ReadTruth(input.scan / "truth");
  const Evaluation whole = Evaluate(result.skeleton, nullptr, truth);
  const Evaluation wires = Evaluate(CurvesNearTruth(result.skeleton, truth), nullptr, truth);
  for (const auto& [name, value] : EvaluationFigures(wires))
    outcome.figures["wires." + name] = value;
  outcome.figures["resolved"] = IsResolved(whole) ? 1 : 0;
  outcome.figures["wires.resolved"] = IsResolved(wires) ? 1 : 0;
  return outcome;
}

const std::vector<TableColumn> kColumns = {{"wires found (of 6)", "wires.components", 0},
                                           {"F5 of wires", "wires.aligned.curves.5mm.f"},
                                           {"F2 of wires", "wires.aligned.curves.2mm.f"},
                                           {"wires resolved", "wires.resolved", 0},
                                           {"all pieces", "components", 0},
                                           {"F5 of all", "aligned.curves.5mm.f"},
                                           {"all resolved", "resolved", 0}};

// The smallest spacing at which, and at all larger ones, `resolved` holds for at least this share
// of the seeds; "none" where it does not hold for the largest. Groups by falling spacing.
std::string SmallestResolved(const std::vector<RunGroup>& groups, const std::string& profile,
                             const std::string& figure, double share) {
  std::string smallest = "none";
  for (const RunGroup& group : groups) {
    if (LabelOf(group.labels, "profile") != profile) continue;
    if (SumOf(group, figure) < share * static_cast<double>(group.runs.size())) break;
    smallest = LabelOf(group.labels, "spacing");
  }
  return smallest;
}

Table SmallestSpacings(const std::vector<RunGroup>& groups, const std::vector<RunGroup>& profiles) {
  Table table{{"profile", "wires, all seeds (mm)", "wires, most seeds (mm)",
               "whole result, all seeds (mm)", "whole result, most seeds (mm)"},
              {},
              1};
  for (const RunGroup& group : profiles) {
    const std::string profile = group.labels.front().second;
    std::vector<std::string> row = {profile};
    for (const char* figure : {"wires.resolved", "resolved"}) {
      for (const double share : {1.0, 0.5}) {
        row.push_back(SmallestResolved(groups, profile, figure, share));
      }
    }
    table.rows.push_back(row);
  }
  return table;
}

std::string PlotCommands(const std::vector<RunGroup>& profiles, double most_wires) {
  const auto curves = [&](int column) {
    std::vector<std::string> parts;
    for (size_t i = 0; i < profiles.size(); ++i) {
      parts.push_back(
          fmt::format("data index {} using ($1{:+}):{}:{}:{} with yerrorlines lt {} title '{}'", i,
                      0.2 * static_cast<double>(i), column, column + 1, column + 2, i + 1,
                      profiles[i].labels.front().second));
    }
    return fmt::format("plot {}\n", fmt::join(parts, ", "));
  };
  return "set datafile missing '?'\nset xrange [42:6]\nset xlabel 'Spacing of wires (mm)'\n"
         "set arrow 1 from first 17,graph 0 to first 17,graph 1 nohead dashtype 2 lc rgb "
         "'#666666'\n"
         "set label 1 'paper: 17 mm' at first 17.6,graph 0.06 right font ',7' tc rgb '#666666'\n"
         "set multiplot layout 1,2 margins 0.07,0.99,0.16,0.83 spacing 0.09,0\n"
         "set title 'Separate curves at the wires'\n" +
         fmt::format("set yrange [0:{}]\n", most_wires + 0.5) +
         "set arrow 2 from graph 0,first 6 to graph 1,first 6 nohead dashtype 3 lc rgb '#666666'\n"
         "set key at screen 0.5,0.985 center top horizontal maxrows 1\n" +
         curves(2) +
         "unset arrow 2\nset arrow 2 from graph 0,first 0.95 to graph 1,first 0.95 nohead dashtype "
         "3 lc rgb '#666666'\nset title 'F at 5 mm, aligned'\nset yrange [0:1.05]\nunset key\n" +
         curves(5) + "unset multiplot";
}

void Report(const StudyResults& results) {
  const std::vector<RunGroup> groups = GroupRuns(results.runs, {"spacing", "profile"});
  const std::vector<RunGroup> profiles = GroupRuns(results.runs, {"profile"});
  WriteTable(results.folder, results.stem, MedianTable(groups, kColumns));
  WriteTable(results.folder, results.stem + "_smallest", SmallestSpacings(groups, profiles));
  DrawPlot(results.folder, results.stem,
           {SpreadBlocks(groups, "profile", "spacing",
                         {"wires.components", "wires.aligned.curves.5mm.f"}),
            PlotCommands(profiles, GreatestOf(results.runs, "wires.components", 7)), 6.5, 2.8});
}

}  // namespace

Study InterWireStudy() {
  return {"inter-wire",
          "Parallel 5 mm wires 40 to 8 mm apart: down to which spacing are they resolved?", Cases,
          Run, Report};
}

}  // namespace curvefusion
