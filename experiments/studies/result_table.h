#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/studies/study.h"

namespace curvefusion {

/// Runs that agree in the labels they were grouped by: usually those of different seeds.
struct RunGroup {
  Labels labels;
  std::vector<const StudyRun*> runs;  ///< pointers into the results; they must outlive the group
};

/// Groups by the values of these labels, in the order in which they first come.
std::vector<RunGroup> GroupRuns(const std::vector<StudyRun>& runs,
                                const std::vector<std::string>& labels);

/// Middle and ends of a figure's values.
struct Spread {
  double median = 0;  ///< of an even number the mean of the middle two
  double least = 0;
  double greatest = 0;
};

/// None for no values.
std::optional<Spread> SpreadOf(std::vector<double> values);

/// Over the group's runs that have the figure; none where none has.
std::optional<Spread> SpreadOf(const RunGroup& group, const std::string& figure);

/// The sum over the group's runs that have the figure, to pool counts.
double SumOf(const RunGroup& group, const std::string& figure);

/// The greatest value of a figure in all runs, but at least `least`: the end of an axis, which
/// gnuplot cannot choose where no run has a value.
double GreatestOf(const std::vector<StudyRun>& runs, const std::string& figure, double least);

/// "median least greatest" for a data file of gnuplot; "? ? ?" for none.
std::string SpreadData(const std::optional<Spread>& spread);

/// Data for gnuplot: a block (gnuplot's `index`) for each value of `block_label`, in it a row for
/// each group with that value: its `row_label` (in quotes where it has spaces), then median, least
/// and greatest of every figure, "?" for those that no run has.
std::string SpreadBlocks(const std::vector<RunGroup>& groups, const std::string& block_label,
                         const std::string& row_label, const std::vector<std::string>& figures);

/// A figure of a standard table.
struct TableColumn {
  std::string heading;
  std::string figure;
  int decimals = 2;
  double scale = 1;  ///< what the figure is multiplied by
};

/// A table for people.
struct Table {
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> rows;
  size_t text_columns = 1;  ///< so many columns from the left hold words, the others numbers
};

/// "0.97 [0.95, 0.98]": median and ends; the median alone where they round to it; "-" for none.
std::string SpreadText(const std::optional<Spread>& spread, int decimals, double scale = 1);

/// A row a group with the medians of the columns. Behind the labels stands the number of runs; how
/// many failed or found nothing where any did.
Table MedianTable(const std::vector<RunGroup>& groups, const std::vector<TableColumn>& columns);

/// As a booktabs tabular, and as Markdown.
std::string LatexTable(const Table& table);
std::string MarkdownTable(const Table& table);

/// Writes folder/NAME.tex and folder/NAME.md.
void WriteTable(const std::filesystem::path& folder, const std::string& name, const Table& table);

}  // namespace curvefusion
