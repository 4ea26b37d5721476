#include "experiments/studies/headline_figures.h"

#include <algorithm>
#include <cassert>
#include <map>

namespace curvefusion {

namespace {

constexpr const char* kNothing = "nothing found";

std::optional<double> ValueOf(const StudyRun& run, const HeadlineFigure& figure) {
  const auto found = run.figures.find(figure.figure);
  if (found != run.figures.end()) return found->second;
  // F has no value where there is no precision; such a result is worth nothing all the same. Of a
  // room without wires it is all that is wanted.
  const auto true_length = run.figures.find("true_length");
  const bool has_wires = true_length == run.figures.end() || true_length->second > 0;
  const bool counts =
      (figure.figure.ends_with(".f") && has_wires) || figure.figure.ends_with(".false_length");
  return run.outcome == kNothing && counts ? std::optional(0.0) : std::nullopt;
}

std::optional<double> MeanOfMedians(const RunGroup& group, const HeadlineFigure& figure) {
  std::map<std::string, std::vector<double>> of_object;
  for (const StudyRun* run : group.runs) {
    const auto value = ValueOf(*run, figure);
    if (value) of_object[LabelOf(run->labels, "object")].push_back(*value);
  }
  if (of_object.empty()) return std::nullopt;
  double sum = 0;
  for (const auto& [object, values] : of_object) sum += SpreadOf(values)->median;
  return sum / static_cast<double>(of_object.size());
}

std::optional<double> RatioOfSums(const RunGroup& group, const HeadlineFigure& figure) {
  const double whole = SumOf(group, figure.other);
  if (whole == 0) return std::nullopt;
  return SumOf(group, figure.figure) / whole;
}

std::optional<double> ShareEqual(const RunGroup& group, const HeadlineFigure& figure) {
  int compared = 0;
  int equal = 0;
  for (const StudyRun* run : group.runs) {
    const auto a = run->figures.find(figure.figure);
    const auto b = run->figures.find(figure.other);
    if (a == run->figures.end() || b == run->figures.end()) continue;
    ++compared;
    equal += a->second == b->second ? 1 : 0;
  }
  if (compared == 0) return std::nullopt;
  return static_cast<double>(equal) / compared;
}

}  // namespace

const std::vector<HeadlineFigure>& HeadlineFigures() {
  static const std::vector<HeadlineFigure> kFigures = {
      {.name = "F5 aligned", .figure = "aligned.curves.5mm.f"},
      {.name = "F2 aligned", .figure = "aligned.curves.2mm.f"},
      {.name = "F2 raw", .figure = "raw.curves.2mm.f"},
      {.name = "F1 aligned", .figure = "aligned.curves.1mm.f"},
      {.name = "false length (m)",
       .figure = "aligned.curves.false_length",
       .more_is_better = false},
      {.name = "junction recall",
       .pooling = Pooling::kRatioOfSums,
       .figure = "aligned.junctions_10mm.matched",
       .other = "aligned.junctions_10mm.truth"},
      {.name = "junction precision",
       .pooling = Pooling::kRatioOfSums,
       .figure = "aligned.junctions_10mm.matched",
       .other = "aligned.junctions_10mm.found"},
      {.name = "cycles exact",
       .pooling = Pooling::kShareEqual,
       .figure = "cycles",
       .other = "true_cycles",
       .decimals = 2},
      {.name = "diameter error (mm)",
       .figure = "raw.diameter.mean_error_mm",
       .more_is_better = false},
      {.name = "CPU s per 30 frames",
       .figure = "cpu_seconds_per_30_frames",
       .decimals = 2,
       .more_is_better = false,
       .is_cost = true}};
  return kFigures;
}

size_t HeadlineIndex(const std::string& name) {
  const auto& figures = HeadlineFigures();
  const auto found = std::find_if(figures.begin(), figures.end(),
                                  [&](const HeadlineFigure& f) { return f.name == name; });
  assert(found != figures.end());
  return static_cast<size_t>(found - figures.begin());
}

std::optional<double> HeadlineValue(const RunGroup& group, const HeadlineFigure& figure) {
  switch (figure.pooling) {
    case Pooling::kMeanOfMedians:
      return MeanOfMedians(group, figure);
    case Pooling::kRatioOfSums:
      return RatioOfSums(group, figure);
    case Pooling::kShareEqual:
      return ShareEqual(group, figure);
  }
  return std::nullopt;
}

std::vector<std::optional<double>> HeadlineValues(const RunGroup& group) {
  std::vector<std::optional<double>> values;
  for (const HeadlineFigure& figure : HeadlineFigures()) {
    values.push_back(HeadlineValue(group, figure));
  }
  return values;
}

std::vector<std::optional<double>> ChangesOf(const std::vector<std::optional<double>>& before,
                                             const std::vector<std::optional<double>>& after) {
  std::vector<std::optional<double>> changes;
  for (size_t i = 0; i < before.size(); ++i) {
    changes.push_back(before[i] && after[i] ? std::optional(*after[i] - *before[i]) : std::nullopt);
  }
  return changes;
}

}  // namespace curvefusion
