#include "experiments/reproduction/measures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace curvefusion {

namespace {

bool HasLabels(const StudyRun& run, const Labels& where) {
  return std::all_of(where.begin(), where.end(), [&](const auto& label) {
    return LabelOf(run.labels, label.first) == label.second;
  });
}

std::optional<double> ValueOf(const StudyRun& run, const std::string& figure) {
  const auto found = run.figures.find(figure);
  if (found != run.figures.end()) return found->second;
  return run.outcome == "nothing found" ? std::optional(0.0) : std::nullopt;
}

std::vector<double> ValuesOf(const RunGroup& group, const std::string& figure,
                             const Labels& where) {
  std::vector<double> values;
  for (const StudyRun* run : group.runs) {
    if (!HasLabels(*run, where)) continue;
    if (const auto value = ValueOf(*run, figure)) values.push_back(*value);
  }
  return values;
}

std::optional<double> MedianIn(const RunGroup& group, const std::string& figure,
                               const Labels& where) {
  const std::optional<Spread> spread = SpreadOf(ValuesOf(group, figure, where));
  return spread ? std::optional(spread->median) : std::nullopt;
}

// The median of a figure at each value of a numeric label, by falling value.
std::map<double, double, std::greater<>> MediansBy(const RunGroup& group, const std::string& figure,
                                                   const std::string& label) {
  std::map<double, double, std::greater<>> medians;
  for (const StudyRun* run : group.runs) {
    const std::string value = LabelOf(run->labels, label);
    if (value.empty()) continue;
    const auto median = MedianIn(group, figure, {{label, value}});
    if (median) medians[std::stod(value)] = *median;
  }
  return medians;
}

// "thickness of wire" in the paper's Table 1, millimetres, by our names of its objects.
const std::map<std::string, std::vector<double>>& TableDiameters_mm() {
  static const std::map<std::string, std::vector<double>> kDiameters = {
      {"dish", {5, 9}},    {"cage", {4.5}},     {"cat", {4.5, 6}},    {"deco", {5.5}},
      {"hanger", {4, 12}}, {"rack", {5.5, 11}}, {"chair", {4.5, 12}}, {"wine", {6}}};
  return kDiameters;
}

double ErrorAgainst(double diameter_mm, const std::vector<double>& true_mm) {
  double least = HUGE_VAL;
  for (const double one : true_mm) least = std::min(least, std::abs(diameter_mm - one) / one);
  return least;
}

}  // namespace

Measure MedianOf(const std::string& figure, const Labels& where) {
  return [=](const RunGroup& group) { return MedianIn(group, figure, where); };
}

Measure LeastOf(const std::string& figure, const Labels& where) {
  return [=](const RunGroup& group) -> std::optional<double> {
    const std::optional<Spread> spread = SpreadOf(ValuesOf(group, figure, where));
    return spread ? std::optional(spread->least) : std::nullopt;
  };
}

Measure MostOf(const std::string& figure, const Labels& where) {
  return [=](const RunGroup& group) -> std::optional<double> {
    const std::optional<Spread> spread = SpreadOf(ValuesOf(group, figure, where));
    return spread ? std::optional(spread->greatest) : std::nullopt;
  };
}

Measure RatioOf(const std::string& part, const std::string& whole, const Labels& where) {
  return [=](const RunGroup& group) -> std::optional<double> {
    double parts = 0, wholes = 0;
    for (const double value : ValuesOf(group, part, where)) parts += value;
    for (const double value : ValuesOf(group, whole, where)) wholes += value;
    return wholes > 0 ? std::optional(parts / wholes) : std::nullopt;
  };
}

Measure DifferenceOf(const std::string& figure, const Labels& these, const Labels& others) {
  return [=](const RunGroup& group) -> std::optional<double> {
    const auto a = MedianIn(group, figure, these);
    const auto b = MedianIn(group, figure, others);
    return a && b ? std::optional(*a - *b) : std::nullopt;
  };
}

Measure LeadOver(const std::string& method, const std::string& figure) {
  return [=](const RunGroup& group) -> std::optional<double> {
    RunGroup subject, others;
    for (const StudyRun* run : group.runs) {
      (HasLabels(*run, {{"method", method}}) ? others : subject).runs.push_back(run);
    }
    const auto a = MedianIn(subject, figure, {});
    const auto b = MedianIn(others, figure, {});
    return a && b ? std::optional(*a - *b) : std::nullopt;
  };
}

Measure AmountOf(const Measure& measure) {
  return [=](const RunGroup& group) -> std::optional<double> {
    const auto value = measure(group);
    return value ? std::optional(std::abs(*value)) : std::nullopt;
  };
}

Measure BelowBestOf(const std::string& figure, const std::string& label, const std::string& value) {
  return [=](const RunGroup& group) -> std::optional<double> {
    const auto medians = MediansBy(group, figure, label);
    const auto here = medians.find(std::stod(value));
    if (here == medians.end() || medians.size() < 2) return std::nullopt;
    double best = here->second;
    for (const auto& [at, median] : medians) best = std::max(best, median);
    return here->second - best;
  };
}

Measure LeastLabelWith(const std::string& figure, const std::string& label, const Labels& where) {
  return [=](const RunGroup& group) -> std::optional<double> {
    RunGroup those;
    for (const StudyRun* run : group.runs) {
      if (HasLabels(*run, where)) those.runs.push_back(run);
    }
    const auto medians = MediansBy(those, figure, label);
    if (medians.empty()) return std::nullopt;
    double least = HUGE_VAL;
    for (const auto& [at, median] : medians) {
      if (median == 0) break;
      least = at;
    }
    return least;
  };
}

Measure FallsOfLeastLabel(const std::string& figure, const std::string& label,
                          const std::vector<Labels>& along) {
  return [=](const RunGroup& group) -> std::optional<double> {
    int falls = 0;
    std::optional<double> before;
    for (const Labels& where : along) {
      const std::optional<double> least = LeastLabelWith(figure, label, where)(group);
      if (!least) return std::nullopt;
      if (before) falls += *least < *before ? 1 : *least > *before ? -1 : 0;
      before = least;
    }
    return falls;
  };
}

Measure TableDiameterError() {
  return [](const RunGroup& group) -> std::optional<double> {
    std::vector<double> errors;
    for (const StudyRun* run : group.runs) {
      const auto known = TableDiameters_mm().find(LabelOf(run->labels, "object"));
      const auto measured = run->figures.find("global_diameter_mm");
      if (known == TableDiameters_mm().end() || measured == run->figures.end()) continue;
      errors.push_back(ErrorAgainst(measured->second, known->second));
    }
    if (errors.empty()) return std::nullopt;
    double sum = 0;
    for (const double error : errors) sum += error;
    return sum / static_cast<double>(errors.size());
  };
}

}  // namespace curvefusion
