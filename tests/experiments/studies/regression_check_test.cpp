#include "experiments/studies/regression_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/studies/studies.h"
#include "experiments/studies/study_runner.h"
#include "kernel/error.h"
#include "tests/experiments/studies/tiny_objects.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

using testing::ElementsAre;

TEST(Baseline, HoldsTheSameRunsOnTheSameScans) {
  const TemporaryFolder folder("baseline");
  StudyRequest request{.profiles = {Profile::kBest}, .seeds = 1, .objects = {"valence6"}};
  const StudyResults results = RunStudy(TinyObjects(), request, folder, {}, NoProgress);
  ASSERT_EQ(results.runs.size(), 1u);
  const auto baseline = ReadBaseline(TinyObjects(), request, folder);
  EXPECT_FALSE(CompareWithBaseline(baseline, results.runs, 0).fell);
  EXPECT_THROW(ReadBaseline(TinyObjects(), request, folder / "none"), Error);
  request.seeds = 2;  // the second was not measured
  EXPECT_THROW(ReadBaseline(TinyObjects(), request, folder), Error);
  request.seeds = 1;  // but not on the scan of the whole study
  EXPECT_THROW(ReadBaseline(ObjectsStudy(), request, folder), Error);
}

StudyRun RunWith(const Figures& figures) {
  return {{{"object", "cage"}, {"setting", "default"}}, 1, "done", "", "", {}, figures};
}

TEST(CompareWithBaseline, JudgesEachFigureInItsOwnDirection) {
  const StudyRun before = RunWith({{"aligned.curves.2mm.f", 0.9},
                                   {"raw.diameter.mean_error_mm", 0.2},
                                   {"cpu_seconds_per_30_frames", 1}});
  const auto fell = [&](const std::string& figure, double value) {
    StudyRun now = before;
    now.figures[figure] = value;
    return CompareWithBaseline({before}, {now}, 0.02).fell;
  };
  EXPECT_FALSE(fell("aligned.curves.2mm.f", 0.885));
  EXPECT_TRUE(fell("aligned.curves.2mm.f", 0.875));
  EXPECT_FALSE(fell("aligned.curves.2mm.f", 1));
  EXPECT_TRUE(fell("raw.diameter.mean_error_mm", 0.23));
  EXPECT_FALSE(fell("raw.diameter.mean_error_mm", 0.1));
  EXPECT_FALSE(fell("cpu_seconds_per_30_frames", 9));  // told, not judged
  StudyRun failed = RunWith({});
  failed.outcome = "failed";
  const RegressionCheck check = CompareWithBaseline({before}, {failed}, 0.02);
  EXPECT_TRUE(check.fell);
  EXPECT_THAT(check.table.headings,
              ElementsAre("setting", "figure", "before", "now", "ratio", "judged"));
}

}  // namespace
}  // namespace curvefusion
