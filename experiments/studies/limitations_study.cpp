// Where does the method break? Wires below 2 mm, wire that lies on a surface or rises from it,
// junctions of valence 3 to 8, and diameters that differ or vary within an object (CurveFusion 5,
// Limitations).
#include <fmt/format.h>

#include <map>

#include "experiments/metrics/evaluation.h"
#include "experiments/metrics/truth.h"
#include "experiments/simulation/limit_objects.h"
#include "experiments/studies/gnuplot.h"
#include "experiments/studies/limit_figures.h"
#include "experiments/studies/reconstruction_run.h"
#include "experiments/studies/result_table.h"
#include "experiments/studies/studies.h"
#include "graph/io/graph_io.h"

namespace curvefusion {

namespace {

constexpr FrameCounts kFrames = {100, 30};

// What is varied within one scan, and the curve that is drawn of it.
struct Limit {
  const char* name;
  std::vector<WireCurve> (*object)();
  std::optional<double> table_gap;
  const char* figure;  // without "_at.X"
  std::vector<std::string> (*places)();
  const char* title;
  const char* axis;
  double top;
};

const std::vector<Limit>& Limits() {
  static const std::vector<Limit> kLimits = {
      {"thickness",
       ThicknessRow,
       {},
       "recall",
       ThicknessPlaces,
       "Recall by thickness",
       "Diameter (mm)",
       1.05},
      {"surface", RisingWires, 0.0, "recall", HeightPlaces, "Recall by distance from a table",
       "Axis above the table (mm)", 1.05},
      {"valence",
       Stars,
       {},
       "junctions",
       ValencePlaces,
       "Junctions in place of one",
       "Valence",
       4.2},
      {"radius",
       MixedRadii,
       {},
       "diameter_mm",
       RadiusPlaces,
       "Measured diameter (mm)",
       "True diameter (mm)",
       14}};
  return kLimits;
}

std::vector<StudyCase> Cases(const StudyRequest& request) {
  std::vector<StudyCase> cases;
  for (const Limit& limit : Limits()) {
    for (const uint64_t seed : SeedsOf(request)) {
      SimulationOptions scan =
          ObjectScan(request, std::string("limit_") + limit.name, seed, kFrames);
      scan.object_options.curves = limit.object();
      scan.scene.table_gap = limit.table_gap;
      for (const Profile profile : request.profiles) {
        cases.push_back({{{"limit", limit.name}, {"profile", ProfileName(profile)}},
                         seed,
                         scan,
                         CaseConfig(request, profile)});
      }
    }
  }
  return cases;
}

RunOutcome Run(const RunInput& input) {
  RunOutcome outcome = input.reconstruct(input);
  const SkeletonGraph truth = ReadTruth(input.scan / "truth");
  const SkeletonGraph result = ReadSkeleton(input.folder / "skeleton.json");
  const SkeletonGraph aligned =
      Transformed(result, Evaluate(result, nullptr, truth).T_truth_result);
  const std::string limit = LabelOf(input.study_case.labels, "limit");
  const auto add = [&](const std::string& name, const std::map<std::string, double>& values) {
    for (const auto& [place, value] : values) outcome.figures[name + "_at." + place] = value;
  };
  if (limit == "thickness") add("recall", RecallByThickness(aligned, truth));
  if (limit == "surface") add("recall", RecallByHeight(aligned, truth));
  if (limit == "radius") add("diameter_mm", DiameterByTruth(aligned, truth));
  if (limit == "valence") {
    add("junctions", JunctionsAtHubs(aligned, truth));
    add("whole", WholeHubs(aligned, truth));
  }
  return outcome;
}

// A block a limit and profile, in it a row a place: "X median least greatest".
std::string PlotData(const std::vector<RunGroup>& groups) {
  std::vector<std::string> blocks;
  for (const Limit& limit : Limits()) {
    for (const RunGroup& group : groups) {
      if (LabelOf(group.labels, "limit") != limit.name) continue;
      std::string block;
      for (const std::string& place : limit.places()) {
        block +=
            fmt::format("{} {}\n", place,
                        SpreadData(SpreadOf(group, fmt::format("{}_at.{}", limit.figure, place))));
      }
      blocks.push_back(block);
    }
  }
  return fmt::format("{}", fmt::join(blocks, "\n\n"));
}

// What a perfect result would draw.
std::string IdealOf(const Limit& limit) { return limit.name == std::string("radius") ? "x" : "1"; }

std::string PlotCommands(const std::vector<RunGroup>& profiles) {
  std::string commands =
      "set datafile missing '?'\n"
      "set multiplot layout 2,2 margins 0.07,0.985,0.11,0.88 spacing 0.09,0.24\n"
      "set key at screen 0.5,0.985 center top horizontal maxrows 1\n";
  size_t block = 0;
  for (const Limit& limit : Limits()) {
    const std::vector<std::string> places = limit.places();
    commands += fmt::format(
        "set title '{}' offset 0,-0.6\nset xlabel '{}' offset 0,0.4\nset yrange [0:{}]\n"
        "set xrange [0:{}*1.06]\n",
        limit.title, limit.axis, limit.top, places.back());
    std::vector<std::string> parts = {
        fmt::format("{} with lines dashtype 3 linecolor rgb '#888888'", IdealOf(limit))};
    for (size_t i = 0; i < profiles.size(); ++i, ++block) {
      parts.push_back(fmt::format("data index {} using 1:2:3:4 with yerrorlines lt {} title '{}'",
                                  block, i + 1, profiles[i].labels.front().second));
    }
    commands += fmt::format("plot {}\nunset key\n", fmt::join(parts, ", "));
  }
  return commands + "unset multiplot";
}

Table PlaceTable(const std::vector<RunGroup>& groups) {
  Table table{{"limit", "profile", "figure", "at", "measured"}, {}, 3};
  for (const RunGroup& group : groups) {
    for (const Limit& limit : Limits()) {
      if (LabelOf(group.labels, "limit") != limit.name) continue;
      for (const std::string& place : limit.places()) {
        const auto spread = SpreadOf(group, fmt::format("{}_at.{}", limit.figure, place));
        table.rows.push_back({limit.name, LabelOf(group.labels, "profile"), limit.title, place,
                              SpreadText(spread, 2)});
      }
    }
  }
  return table;
}

void Report(const StudyResults& results) {
  const std::vector<RunGroup> groups = GroupRuns(results.runs, {"limit", "profile"});
  WriteTable(results.folder, results.stem, PlaceTable(groups));
  DrawPlot(results.folder, results.stem,
           {PlotData(groups), PlotCommands(GroupRuns(results.runs, {"profile"})), 6.5, 4.4});
}

}  // namespace

Study LimitationsStudy() {
  return {"limitations",
          "Thin wires, wire near a table, junctions of valence 3 to 8, mixed and varying diameters",
          Cases, Run, Report};
}

}  // namespace curvefusion
