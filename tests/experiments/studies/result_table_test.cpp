#include "experiments/studies/result_table.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

StudyRun RunOf(const std::string& object, uint64_t seed, const Figures& figures,
               const std::string& outcome = "done") {
  return {{{"object", object}, {"profile", "best"}}, seed, outcome, "", "", "", figures};
}

TEST(ResultTable, MedianAndEndsOverSeeds) {
  const std::vector<StudyRun> runs = {RunOf("a", 1, {{"f", 3}}), RunOf("b", 1, {{"f", 7}}),
                                      RunOf("a", 2, {{"f", 1}}), RunOf("a", 3, {{"f", 2}})};
  const auto groups = GroupRuns(runs, {"object"});
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].labels, (Labels{{"object", "a"}}));
  const Spread spread = *SpreadOf(groups[0], "f");
  EXPECT_EQ(spread.median, 2);
  EXPECT_EQ(spread.least, 1);
  EXPECT_EQ(spread.greatest, 3);
  EXPECT_EQ(SumOf(groups[0], "f"), 6);
}

TEST(ResultTable, MedianOfAnEvenNumberLiesBetweenTheMiddleTwo) {
  const std::vector<StudyRun> runs = {RunOf("a", 1, {{"f", 1}}), RunOf("a", 2, {{"f", 4}})};
  EXPECT_EQ(SpreadOf(GroupRuns(runs, {"object"})[0], "f")->median, 2.5);
}

TEST(ResultTable, BlocksForGnuplot) {
  std::vector<StudyRun> runs = {RunOf("a", 1, {{"f", 1}}), RunOf("b", 1, {{"f", 2}})};
  runs.push_back(runs[0]);
  runs[2].labels[1].second = "paper";
  runs[2].figures = {{"other", 4}};
  EXPECT_EQ(SpreadBlocks(GroupRuns(runs, {"object", "profile"}), "profile", "object", {"f"}),
            "# best\na 1 1 1\nb 2 2 2\n\n\n# paper\na ? ? ?\n");
  const std::vector<StudyRun> spaced = {RunOf("of a bundle", 1, {{"f", 1}})};
  EXPECT_EQ(SpreadBlocks(GroupRuns(spaced, {"object", "profile"}), "profile", "object", {"f"}),
            "# best\n\"of a bundle\" 1 1 1\n");  // one column
  EXPECT_EQ(GreatestOf(runs, "f", 0.5), 2);
  EXPECT_EQ(GreatestOf(runs, "none", 0.5), 0.5);
}

TEST(ResultTable, SpreadsAsText) {
  EXPECT_EQ(SpreadText(std::nullopt, 2), "-");
  EXPECT_EQ(SpreadText(Spread{0.5, 0.5, 0.5}, 2), "0.50");
  EXPECT_EQ(SpreadText(Spread{0.5, 0.499, 0.501}, 2), "0.50");  // they round to the median
  EXPECT_EQ(SpreadText(Spread{0.001, 0.0005, 0.002}, 1, 1000), "1.0 [0.5, 2.0]");
}

TEST(ResultTable, RunsWithoutResultAreCounted) {
  const std::vector<StudyRun> runs = {RunOf("a", 1, {{"f", 1}}), RunOf("a", 2, {}, "failed"),
                                      RunOf("a", 3, {{"f", 0}}, "nothing found")};
  const Table table = MedianTable(GroupRuns(runs, {"object"}), {{"F", "f", 1}});
  EXPECT_EQ(table.headings, (std::vector<std::string>{"object", "runs", "F"}));
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0],
            (std::vector<std::string>{"a", "3, 1 empty, 1 failed", "0.5 [0.0, 1.0]"}));
}

TEST(ResultTable, LatexAndMarkdown) {
  const Table table{{"object", "share %"}, {{"a_b", "0.5"}}, 1};
  EXPECT_EQ(LatexTable(table),
            "\\begin{tabular}{lr}\n\\toprule\nobject & share \\% \\\\\n\\midrule\n"
            "a\\_b & 0.5 \\\\\n\\bottomrule\n\\end{tabular}\n");
  EXPECT_EQ(MarkdownTable(table), "| object | share % |\n| --- | --: |\n| a_b | 0.5 |\n");
}

TEST(ResultTable, NoGroupsNoTable) { EXPECT_TRUE(MedianTable({}, {}).headings.empty()); }

}  // namespace
}  // namespace curvefusion
