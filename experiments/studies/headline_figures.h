#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/studies/result_table.h"

namespace curvefusion {

/// How runs of several objects and seeds become one number.
enum class Pooling {
  kMeanOfMedians,  ///< the median over an object's seeds, then the mean over objects
  kRatioOfSums,    ///< of counts, as the paper counts its 95 % of all junctions
  kShareEqual      ///< the share of runs in which both figures are the same
};

/// A number by which settings are compared.
struct HeadlineFigure {
  std::string name;
  Pooling pooling = Pooling::kMeanOfMedians;
  std::string figure;
  std::string other = {};  ///< the denominator, or what `figure` should equal
  int decimals = 3;
  bool more_is_better = true;
  bool is_cost = false;  ///< depends on the machine
};

/// F within 5, 2 and 1 mm, false length, junctions within 10 mm, cycles, diameters, cost.
const std::vector<HeadlineFigure>& HeadlineFigures();

/// Where the figure of that name stands in HeadlineFigures(); there must be one.
size_t HeadlineIndex(const std::string& name);

/// The value of a figure for a group of runs: none where no run has it. A run may stand in a group
/// more than once.
std::optional<double> HeadlineValue(const RunGroup& group, const HeadlineFigure& figure);

/// Their values for a group of runs, in that order; none where no run has the figure. A result
/// without any curve counts with F = 0 where there are wires, and with no false length; failed runs
/// are left out.
std::vector<std::optional<double>> HeadlineValues(const RunGroup& group);

/// Appends a column for every headline figure to a table that has a row a group;
/// cell(group, figure) gives the text.
template <class Cell>
void AddHeadlineColumns(Table& table, const Cell& cell) {
  const std::vector<HeadlineFigure>& figures = HeadlineFigures();
  for (size_t f = 0; f < figures.size(); ++f) {
    table.headings.push_back(figures[f].name);
    for (size_t row = 0; row < table.rows.size(); ++row) table.rows[row].push_back(cell(row, f));
  }
}

/// What changed from `before` to `after`; none where either has no value.
std::vector<std::optional<double>> ChangesOf(const std::vector<std::optional<double>>& before,
                                             const std::vector<std::optional<double>>& after);

}  // namespace curvefusion
