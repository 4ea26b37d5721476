#include "experiments/reproduction/reproduction_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/studies/study_runner.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

constexpr const char* kWords =
    "A verdict compares the median over seeds with a bound. *Reproduced*: our implementation does "
    "what the paper says of its method, or fails where the paper says that it fails. *Exceeded*: "
    "more than the paper claims, or no failure where the paper has one. *Not reproduced*: less. "
    "For "
    "another method or sensor that the paper says fails, *reproduced* means that it fails here "
    "too. "
    "*Not measured*: no study, or no finished run of that case. F at 2 or 5 mm is the harmonic "
    "mean "
    "of precision and recall within that distance, after one rigid alignment to the truth. In "
    "brackets: least and greatest seed.";

std::string OptionsOf(const StudyRequest& request) {
  std::string options = request.quick ? " --quick" : "";
  if (request.split != Split::kTrain) options += " --split " + SplitName(request.split);
  if (request.profiles.size() == 1) options += " --profile " + ProfileName(request.profiles[0]);
  if (request.seeds > 0) options += fmt::format(" --seeds {}", request.seeds);
  if (!request.objects.empty()) {
    options += fmt::format(" --objects {}", fmt::join(request.objects, ","));
  }
  if (!request.sensor.empty()) options += " --sensor " + request.sensor;
  for (const std::string& assignment : request.assignments) options += " --set " + assignment;
  return options;
}

std::string CommandOf(const std::string& name, const StudyRequest& request) {
  return "curvefusion experiment " + name + " -o DIR" + OptionsOf(request);
}

std::string BoundText(const Claim& claim) {
  if (!claim.measure) return "";
  const auto number = [&](double value) { return fmt::format("{:.{}f}", value, claim.decimals); };
  const char* sign = claim.bound.at_most ? "<=" : ">=";
  std::string text = fmt::format("{} {}", sign, number(claim.bound.value));
  if (claim.bound.beyond) text += fmt::format("; beyond {} {}", sign, number(*claim.bound.beyond));
  return text + " (" + claim.origin + ")";
}

// What the bound means: success of the paper's method, or of what it says fails.
std::string TestText(const Claim& claim) {
  if (!claim.measure) return "not measured: " + claim.figure;
  const char* means = claim.kind == ClaimKind::kWorks ? "holds" : "works after all";
  return fmt::format("{}; {} if {}", claim.figure, means, BoundText(claim));
}

bool IsProfile(const std::string& subject) { return subject == "paper" || subject == "best"; }

// A study that is not finished gives verdicts of what there is, and says so.
std::string ResultCell(const JudgedClaim& judged, const Reproduction& reproduction) {
  if (!judged.claim->measure) return "not measured";
  std::vector<std::string> lines;
  bool failed = false, measured = false;
  for (const ClaimResult& result : judged.results) {
    lines.push_back(result.subject + ": " + ResultText(*judged.claim, result));
    failed = failed || result.verdict == Verdict::kNotReproduced;
    measured = measured || result.verdict != Verdict::kNotMeasured;
  }
  const StudyState& state = reproduction.studies.at(judged.claim->study);
  const int finished = static_cast<int>(state.finished.runs.size());
  if (measured && finished < state.planned) {
    lines.push_back(fmt::format("from {} of {} runs", finished, state.planned));
  }
  if (failed && !judged.claim->cause.empty()) {
    lines.push_back("why: `docs/" + judged.claim->cause + "`");
  }
  return fmt::format("{}", fmt::join(lines, "<br>"));
}

Table CountTable(const Reproduction& reproduction) {
  constexpr Verdict kVerdicts[] = {Verdict::kReproduced, Verdict::kExceeded,
                                   Verdict::kNotReproduced, Verdict::kNotMeasured};
  Table table{{"judged"}, {}, 1};
  for (const Verdict verdict : kVerdicts) table.headings.push_back(VerdictName(verdict));
  for (const std::string row : {"paper", "best", "other methods and sensors"}) {
    std::vector<std::string> cells = {row};
    for (const Verdict verdict : kVerdicts) {
      int count = 0;
      for (const JudgedClaim& judged : reproduction.claims) {
        for (const ClaimResult& result : judged.results) {
          const std::string name =
              IsProfile(result.subject) ? result.subject : "other methods and sensors";
          count += name == row && result.verdict == verdict ? 1 : 0;
        }
      }
      cells.push_back(std::to_string(count));
    }
    table.rows.push_back(cells);
  }
  return table;
}

std::string Head(const Reproduction& reproduction, const StudyRequest& request) {
  std::set<std::string> revisions;
  bool has_quick = false;
  for (const auto& [name, state] : reproduction.studies) {
    has_quick = has_quick || state.request.quick;
    revisions.insert(state.revisions.begin(), state.revisions.end());
  }
  std::string text = fmt::format(
      "# Reproduction of the paper\n\nGenerated from finished runs; do not edit. Measure and write "
      "it:\n\n```\n{}\n```\n\n`{}` writes it again without measuring. ",
      CommandOf("all", request), CommandOf("reproduction", request));
  text += fmt::format(
      "The scans are simulated (split {}, {} seed{}), as the paper's are not "
      "public.",
      SplitName(request.split), SeedsOf(request).size(), SeedsOf(request).size() == 1 ? "" : "s");
  if (has_quick) {
    text +=
        " Commands with `--quick` are of few objects with 30 to 80 frames instead of the paper's "
        "several hundred. A verdict on them is of these scans and may change at full size.";
  }
  if (!revisions.empty()) {
    text += fmt::format(" Revision{} of the program: {}.", revisions.size() == 1 ? "" : "s",
                        fmt::join(revisions, ", "));
  }
  return text + "\n\n" + MarkdownTable(CountTable(reproduction)) + "\n" + kWords + "\n";
}

std::string StudyText(const Reproduction& reproduction, const std::string& name,
                      const std::string& pictures) {
  const StudyState& state = reproduction.studies.at(name);
  std::string text =
      fmt::format("\n`{}`: {} of {} runs finished.\n", CommandOf(name, state.request),
                  state.finished.runs.size(), state.planned);
  if (state.finished.runs.empty()) return text;
  for (const std::string& picture : PicturesOf(state.finished)) {
    text += fmt::format("\n![Figure of the study {}]({}/{})\n", name, pictures, picture);
  }
  return text;
}

}  // namespace

std::string ResultText(const Claim& claim, const ClaimResult& result) {
  if (!result.figure) return "not measured";
  const std::string figure =
      std::isfinite(result.figure->median) ? SpreadText(result.figure, claim.decimals) : "none";
  return figure + ": " + VerdictName(result.verdict) +
         (result.on_every_seed ? "" : ", not on every seed");
}

Table ClaimTable(const Reproduction& reproduction) {
  Table table{{"topic", "claim", "place", "figure", "bound", "of", "measured", "verdict"}, {}, 8};
  for (const JudgedClaim& judged : reproduction.claims) {
    for (const ClaimResult& result : judged.results) {
      const Claim& claim = *judged.claim;
      table.rows.push_back({claim.topic, claim.words, claim.place, claim.figure, BoundText(claim),
                            result.subject, SpreadText(result.figure, claim.decimals),
                            VerdictName(result.verdict)});
    }
  }
  return table;
}

std::vector<std::string> PicturesOf(const StudyResults& results) {
  std::vector<std::string> names;
  if (!fs::is_directory(results.folder)) return names;
  for (const auto& entry : fs::directory_iterator(results.folder)) {
    const std::string name = entry.path().filename().string();
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() != ".png" || stem.rfind(results.stem, 0) != 0) continue;
    // STEM_quick is another study's stem.
    const std::string rest = stem.substr(results.stem.size());
    if (rest.empty() || (rest[0] == '_' && rest.rfind("_quick", 0) != 0)) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string ReproductionPage(const Reproduction& reproduction, const StudyRequest& request,
                             const std::string& pictures) {
  std::string text = Head(reproduction, request);
  std::set<std::string> shown;  // studies whose pictures are on the page
  for (size_t begin = 0, end = 0; begin < reproduction.claims.size(); begin = end) {
    const std::string& topic = reproduction.claims[begin].claim->topic;
    Table table{{"the paper", "where", "what is measured", "result"}, {}, 4};
    std::vector<std::string> studies;
    while (end < reproduction.claims.size() && reproduction.claims[end].claim->topic == topic) {
      const JudgedClaim& judged = reproduction.claims[end++];
      const Claim& claim = *judged.claim;
      table.rows.push_back(
          {claim.words, claim.place, TestText(claim), ResultCell(judged, reproduction)});
      if (!claim.study.empty() && shown.insert(claim.study).second) {
        studies.push_back(claim.study);
      }
    }
    text += "\n## " + topic + "\n\n" + MarkdownTable(table);
    for (const std::string& study : studies) {
      text += StudyText(reproduction, study, pictures);
    }
  }
  return text;
}

}  // namespace curvefusion
