// What studies make of their runs, from made-up figures.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "experiments/metrics/evaluation_files.h"
#include "experiments/studies/gnuplot.h"
#include "experiments/studies/studies.h"
#include "experiments/studies/study_runner.h"
#include "tests/experiments/studies/gnuplot_fixture.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

class Reports : public WithGnuplot {
 protected:
  // All cases of a study, measured so.
  StudyResults Results(const Study& study, const std::string& outcome, const Figures& figures) {
    StudyResults results{folder_, study.name, {}};
    for (const StudyCase& study_case : study.cases({})) {
      results.runs.push_back(
          {study_case.labels, study_case.seed, outcome, "", "", folder_ / "none", figures});
    }
    return results;
  }

  std::set<std::string> Written(const std::string& extension) const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      if (entry.path().extension() == extension) names.insert(entry.path().stem().string());
    }
    return names;
  }

  const TemporaryFolder folder_{"reports"};
};

// Figures of a perfect result of one straight curve, and what studies add.
Figures PerfectFigures() {
  SkeletonGraph graph;
  const EdgeId edge = graph.AddPolyline({{0, 0, 0}, {0, 0, 0.1}});
  graph.SetCurve(edge, graph.edge(edge).points, {0.002, 0.002});
  const Figures evaluation = EvaluationFigures(Evaluate(graph, nullptr, graph));
  Figures figures = evaluation;
  for (const auto& [name, value] : evaluation) figures["wires." + name] = value;
  for (const char* name : {"resolved", "wires.resolved", "F5", "F2", "pieces"}) figures[name] = 1;
  return figures;
}

TEST_F(Reports, OfMeasuredRunsHaveTablesAndFigures) {
  for (const Study& study : AllStudies()) {
    if (!study.report) continue;
    study.report(Results(study, "done", PerfectFigures()));
    for (const char* extension : {".png", ".pdf", ".tex", ".md"}) {
      const bool is_chart = extension[1] == 'p';
      if (is_chart && study.name == "check") continue;  // names have no chart
      EXPECT_EQ(Written(extension).count(study.name), 1u) << study.name << extension;
    }
  }
}

TEST_F(Reports, OfFailedRunsAreWrittenToo) {
  for (const Study& study : AllStudies()) {
    if (!study.report) continue;
    EXPECT_NO_THROW(study.report(Results(study, "failed", {}))) << study.name;
  }
}

}  // namespace
}  // namespace curvefusion
