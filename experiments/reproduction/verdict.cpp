#include "experiments/reproduction/verdict.h"

#include <algorithm>
#include <set>

namespace curvefusion {

namespace {

bool IsOf(const StudyRun& run, const std::string& subject) {
  bool is_labelled = false;
  for (const char* label : {"profile", "method"}) {
    const std::string value = LabelOf(run.labels, label);
    if (value == subject) return true;
    is_labelled = is_labelled || !value.empty();
  }
  return !is_labelled;
}

std::vector<double> FigureOfSeeds(const Claim& claim, const std::vector<StudyRun>& runs) {
  std::set<uint64_t> seeds;
  for (const StudyRun& run : runs) seeds.insert(run.seed);
  std::vector<double> figures;
  for (const uint64_t seed : seeds) {
    RunGroup group;
    for (const StudyRun& run : runs) {
      if (run.seed == seed) group.runs.push_back(&run);
    }
    if (const auto figure = claim.measure(group)) figures.push_back(*figure);
  }
  return figures;
}

ClaimResult ResultOf(const Claim& claim, const std::vector<StudyRun>& runs,
                     const std::string& subject) {
  ClaimResult result{.subject = subject};
  if (!claim.measure) return result;
  std::vector<StudyRun> measured = RunsOf(runs, subject);
  if (!claim.beside.empty()) {
    const std::vector<StudyRun> others = RunsOf(runs, claim.beside);
    measured.insert(measured.end(), others.begin(), others.end());
  }
  const std::vector<double> figures = FigureOfSeeds(claim, measured);
  result.figure = SpreadOf(figures);
  result.seeds = static_cast<int>(figures.size());
  if (!result.figure) return result;
  result.verdict = VerdictOn(claim, result.figure->median);
  result.on_every_seed = std::all_of(figures.begin(), figures.end(), [&](double figure) {
    return VerdictOn(claim, figure) == result.verdict;
  });
  return result;
}

}  // namespace

std::string VerdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::kReproduced:
      return "reproduced";
    case Verdict::kExceeded:
      return "exceeded";
    case Verdict::kNotReproduced:
      return "not reproduced";
    case Verdict::kNotMeasured:
      break;
  }
  return "not measured";
}

std::vector<StudyRun> RunsOf(const std::vector<StudyRun>& runs, const std::string& subject) {
  std::vector<StudyRun> mine;
  for (const StudyRun& run : runs) {
    if (run.outcome != "failed" && IsOf(run, subject)) mine.push_back(run);
  }
  return mine;
}

Verdict VerdictOn(const Claim& claim, double figure) {
  const bool holds = claim.bound.Holds(figure);
  switch (claim.kind) {
    case ClaimKind::kWorks:
      if (!holds) return Verdict::kNotReproduced;
      return claim.bound.IsExceeded(figure) ? Verdict::kExceeded : Verdict::kReproduced;
    case ClaimKind::kFails:
      return holds ? Verdict::kExceeded : Verdict::kReproduced;
    case ClaimKind::kOthersFail:
      break;
  }
  return holds ? Verdict::kNotReproduced : Verdict::kReproduced;
}

std::vector<ClaimResult> Judge(const Claim& claim, const std::vector<StudyRun>& runs) {
  std::vector<ClaimResult> results;
  for (const std::string& subject : claim.subjects) {
    results.push_back(ResultOf(claim, runs, subject));
  }
  return results;
}

}  // namespace curvefusion
