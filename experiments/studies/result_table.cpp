#include "experiments/studies/result_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "kernel/atomic_file.h"

namespace curvefusion {

namespace {

std::vector<double> ValuesOf(const RunGroup& group, const std::string& figure) {
  std::vector<double> values;
  for (const StudyRun* run : group.runs) {
    const auto found = run->figures.find(figure);
    if (found != run->figures.end()) values.push_back(found->second);
  }
  return values;
}

std::string RunCount(const RunGroup& group) {
  const auto count = [&](const char* outcome) {
    return std::count_if(group.runs.begin(), group.runs.end(),
                         [&](const StudyRun* run) { return run->outcome == outcome; });
  };
  std::string text = std::to_string(group.runs.size());
  if (count("nothing found") > 0) text += fmt::format(", {} empty", count("nothing found"));
  if (count("failed") > 0) text += fmt::format(", {} failed", count("failed"));
  return text;
}

std::string EscapedForLatex(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string("%_&#$").find(c) != std::string::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string Joined(const std::vector<std::string>& cells, const std::string& separator) {
  return fmt::format("{}", fmt::join(cells, separator));
}

}  // namespace

std::vector<RunGroup> GroupRuns(const std::vector<StudyRun>& runs,
                                const std::vector<std::string>& labels) {
  std::vector<RunGroup> groups;
  for (const StudyRun& run : runs) {
    Labels key;
    for (const std::string& label : labels) key.emplace_back(label, LabelOf(run.labels, label));
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const RunGroup& known) { return known.labels == key; });
    if (group == groups.end()) group = groups.insert(groups.end(), {key, {}});
    group->runs.push_back(&run);
  }
  return groups;
}

std::optional<Spread> SpreadOf(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const size_t upper = values.size() / 2;
  const size_t lower = (values.size() - 1) / 2;
  return Spread{(values[lower] + values[upper]) / 2, values.front(), values.back()};
}

std::optional<Spread> SpreadOf(const RunGroup& group, const std::string& figure) {
  return SpreadOf(ValuesOf(group, figure));
}

double SumOf(const RunGroup& group, const std::string& figure) {
  double sum = 0;
  for (const double value : ValuesOf(group, figure)) sum += value;
  return sum;
}

double GreatestOf(const std::vector<StudyRun>& runs, const std::string& figure, double least) {
  double greatest = least;
  for (const StudyRun& run : runs) {
    const auto found = run.figures.find(figure);
    if (found != run.figures.end()) greatest = std::max(greatest, found->second);
  }
  return greatest;
}

std::string SpreadData(const std::optional<Spread>& spread) {
  if (!spread) return "? ? ?";
  return fmt::format("{} {} {}", spread->median, spread->least, spread->greatest);
}

std::string SpreadBlocks(const std::vector<RunGroup>& groups, const std::string& block_label,
                         const std::string& row_label, const std::vector<std::string>& figures) {
  std::vector<std::string> names;
  std::vector<std::string> blocks;
  for (const RunGroup& group : groups) {
    const std::string name = LabelOf(group.labels, block_label);
    const auto place = std::find(names.begin(), names.end(), name) - names.begin();
    if (place == static_cast<std::ptrdiff_t>(names.size())) {
      names.push_back(name);
      blocks.push_back("# " + name + "\n");
    }
    const std::string row = LabelOf(group.labels, row_label);
    blocks[place] += row.find(' ') == std::string::npos ? row : '"' + row + '"';
    for (const std::string& figure : figures)
      blocks[place] += fmt::format(" {}", SpreadData(SpreadOf(group, figure)));
    blocks[place] += "\n";
  }
  return Joined(blocks, "\n\n");
}

std::string SpreadText(const std::optional<Spread>& spread, int decimals, double scale) {
  if (!spread) return "-";
  const auto number = [&](double value) { return fmt::format("{:.{}f}", value * scale, decimals); };
  const std::string median = number(spread->median);
  const std::string least = number(spread->least);
  const std::string greatest = number(spread->greatest);
  if (least == median && greatest == median) return median;
  return fmt::format("{} [{}, {}]", median, least, greatest);
}

Table MedianTable(const std::vector<RunGroup>& groups, const std::vector<TableColumn>& columns) {
  Table table;
  if (groups.empty()) return table;
  for (const auto& [name, value] : groups.front().labels) table.headings.push_back(name);
  table.text_columns = table.headings.size();
  table.headings.push_back("runs");
  for (const TableColumn& column : columns) table.headings.push_back(column.heading);
  for (const RunGroup& group : groups) {
    std::vector<std::string> row;
    for (const auto& [name, value] : group.labels) row.push_back(value);
    row.push_back(RunCount(group));
    for (const TableColumn& column : columns) {
      row.push_back(SpreadText(SpreadOf(group, column.figure), column.decimals, column.scale));
    }
    table.rows.push_back(row);
  }
  return table;
}

std::string LatexTable(const Table& table) {
  const std::string alignment = std::string(table.text_columns, 'l') +
                                std::string(table.headings.size() - table.text_columns, 'r');
  std::string text = "\\begin{tabular}{" + alignment + "}\n\\toprule\n";
  const auto add_row = [&](const std::vector<std::string>& cells) {
    text += EscapedForLatex(cells.front());
    for (size_t i = 1; i < cells.size(); ++i) text += " & " + EscapedForLatex(cells[i]);
    text += " \\\\\n";
  };
  add_row(table.headings);
  text += "\\midrule\n";
  for (const auto& row : table.rows) add_row(row);
  return text + "\\bottomrule\n\\end{tabular}\n";
}

std::string MarkdownTable(const Table& table) {
  std::vector<std::string> rule;
  for (size_t i = 0; i < table.headings.size(); ++i) {
    rule.emplace_back(i < table.text_columns ? "---" : "--:");
  }
  std::string text = "| " + Joined(table.headings, " | ") + " |\n| " + Joined(rule, " | ") + " |\n";
  for (const auto& row : table.rows) text += "| " + Joined(row, " | ") + " |\n";
  return text;
}

void WriteTable(const std::filesystem::path& folder, const std::string& name, const Table& table) {
  if (table.headings.empty()) return;
  WriteStreamAtomically(folder / (name + ".tex"),
                        [&](std::ostream& stream) { stream << LatexTable(table); });
  WriteStreamAtomically(folder / (name + ".md"),
                        [&](std::ostream& stream) { stream << MarkdownTable(table); });
}

}  // namespace curvefusion
