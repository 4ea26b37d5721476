// Does `check` name what is wrong with a scan, and leave good ones alone? Simulated scans with one
// mistake each, and good ones of other objects, sensors, motions and trackers; real recordings
// where the request names their folders.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "capture/check.h"
#include "experiments/studies/result_table.h"
#include "experiments/studies/studies.h"
#include "experiments/studies/wrong_versions.h"
#include "kernel/atomic_file.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

constexpr int kFrames = 90;
constexpr int kQuickFrames = 45;
constexpr size_t kVersionsOfOne = 7;  // wrong versions of a simulated scan; 5 scans have 35
constexpr size_t kVersionsOfRealScan = 5;
constexpr const char* kNothing = "nothing";

// What `check` may say of poses, depth unit, clocks and order.
const std::set<std::string>& GeometryCauses() {
  static const std::set<std::string> causes = {
      "poses-inverted",  "quaternion-w-first",  "opengl-axes", "translation-scale",
      "depth-scale",     "depth-bytes-swapped", "poses-late",  "clock-offset",
      "colour-late",     "frame-order",         "pose-jump",   "bad-stretch",
      "poses-do-not-fit"};
  return causes;
}

SimulationOptions Simulated(const StudyRequest& request, const std::string& object, uint64_t seed) {
  SimulationOptions scan = ObjectScan(request, object, seed);
  scan.frames = request.quick ? kQuickFrames : kFrames;
  return scan;
}

std::vector<SimulationOptions> ScansToSpoil(const StudyRequest& request, uint64_t seed) {
  if (request.quick) return {Simulated(request, "cage", seed)};
  std::vector<SimulationOptions> scans;
  for (const char* object : {"cage", "cat", "rack", "hanger", "stool"}) {
    scans.push_back(Simulated(request, object, seed + scans.size()));
  }
  return scans;
}

SimulationOptions With(SimulationOptions scan, const std::string& sensor,
                       const std::string& pose_source) {
  scan.sensor = sensor;
  scan.pose_source = pose_source;
  return scan;
}

SimulationOptions Moving(SimulationOptions scan, double speed, int frames) {
  scan.motion.speed = speed;
  scan.frames = frames;
  return scan;
}

// Other objects and seeds than those to spoil, other sensors, trackers, speeds and lengths.
std::vector<SimulationOptions> GoodScans(const StudyRequest& request, uint64_t seed) {
  const auto scan = [&](const char* object, uint64_t more) {
    return Simulated(request, object, seed + 20 + more);
  };
  if (request.quick) return {scan("deco", 0), With(scan("cat", 1), "primesense", "ptam")};
  SimulationOptions shaky = With(scan("ladder", 13), "kinect_v1", "ptam");
  shaky.pose_error_scale = 1.5;
  return {scan("deco", 0),
          With(scan("wine", 1), "kinect_v1", "kinfu"),
          With(scan("chair", 2), "kinect_v1", "ptam"),
          With(scan("dish", 3), "kinect_v1", "bundlefusion"),
          With(scan("basket", 4), "primesense", "orbslam2"),
          With(scan("rack", 5), "kinect_v2", "orbslam2"),
          With(scan("dome", 6), "sr300", "kinfu"),
          With(scan("shelf", 7), "kinect_v1", "true"),
          Moving(scan("spring", 8), 0.15, 12),
          Moving(scan("knot", 9), 0.5, kFrames),
          Moving(scan("coat_stand", 10), 0.05, kFrames),
          With(Moving(scan("cubeframe", 11), 0.3, 30), "kinect_v1", "ptam"),
          scan("empty", 12),
          shaky};
}

StudyCase CaseOf(const std::string& scan, const std::string& version, const std::string& expected,
                 uint64_t seed, const std::string& folder = "") {
  return {{{"scan", scan}, {"version", version}, {"expected", expected}, {"folder", folder}},
          seed,
          std::nullopt,
          Config()};
}

std::string NameOf(const SimulationOptions& scan) {
  return fmt::format("{}_{}_{}_{}{}", scan.object, scan.sensor, scan.pose_source, scan.frames,
                     scan.motion.speed == 0.15 ? "" : fmt::format("_{}", scan.motion.speed));
}

void AddWrongCases(const StudyRequest& request, uint64_t seed, std::vector<StudyCase>& cases) {
  const std::vector<WrongVersion> versions = WrongVersions();
  size_t next = 0;
  for (const SimulationOptions& scan : ScansToSpoil(request, seed)) {
    for (size_t i = 0; i < kVersionsOfOne; ++i, ++next) {
      // 11 and 30 have no common divisor: every version comes before any comes again.
      const WrongVersion& version = versions[next * 11 % versions.size()];
      cases.push_back(CaseOf(NameOf(scan), version.name, version.cause, scan.seed));
      cases.back().scan = scan;
    }
  }
}

// Of a real scan with one pose a frame: stamps are no clocks there.
void AddRealCases(const std::filesystem::path& folder, std::vector<StudyCase>& cases) {
  const std::string name = folder.filename().string();
  cases.push_back(CaseOf(name, "good", kNothing, 0, folder.string()));
  if (name.find("cable") == std::string::npos) return;
  constexpr std::array<const char*, kVersionsOfRealScan> kVersions = {
      "inverted", "opengl", "translations_mm", "poses_late_2", "images_in_text_order"};
  for (const WrongVersion& version : WrongVersions()) {
    if (std::find(kVersions.begin(), kVersions.end(), version.name) == kVersions.end()) continue;
    cases.push_back(CaseOf(name, version.name, version.cause, 0, folder.string()));
  }
}

std::vector<StudyCase> Cases(const StudyRequest& request) {
  const uint64_t seed = SeedsOf(request).front();
  std::vector<StudyCase> cases;
  AddWrongCases(request, seed, cases);
  for (const SimulationOptions& scan : GoodScans(request, seed)) {
    cases.push_back(CaseOf(NameOf(scan), "good", kNothing, scan.seed));
    cases.back().scan = scan;
  }
  for (const std::filesystem::path& folder : request.scans) AddRealCases(folder, cases);
  return cases;
}

// The first geometric cause that the report names.
std::string NamedCause(const CheckReport& report) {
  for (const CheckFinding& finding : report.findings) {
    if (GeometryCauses().contains(finding.cause)) return finding.cause;
  }
  return kNothing;
}

std::string Text(const CheckReport& report) {
  std::string text = NamedCause(report) + "\n";
  for (const CheckFinding& finding : report.findings) text += finding.message + "\n";
  return text;
}

RunOutcome Run(const RunInput& input) {
  const Labels& labels = input.study_case.labels;
  const std::string real = LabelOf(labels, "folder");
  const std::filesystem::path scan = real.empty() ? input.scan : std::filesystem::path(real);
  const std::string version = LabelOf(labels, "version");
  std::filesystem::path checked = scan;
  if (version != "good") {
    checked = input.folder / "scan";
    WriteWrongVersion(scan, version, checked);
  }
  const CheckReport report = CheckSequence(checked, input.progress);
  WriteStreamAtomically(input.folder / "check.txt",
                        [&](std::ostream& stream) { stream << Text(report); });
  RunOutcome outcome;
  outcome.figures["right"] = NamedCause(report) == LabelOf(labels, "expected") ? 1 : 0;
  outcome.figures["has_correction"] = report.geometry.correction ? 1 : 0;
  for (const DepthDisagreement& part : report.geometry.by_gap) {
    outcome.figures[fmt::format("gap_{}.residual_mm", part.gap)] = 1e3 * part.residual;
    outcome.figures[fmt::format("gap_{}.overlap", part.gap)] = part.overlap;
  }
  return outcome;
}

std::string FirstLine(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return "-";
  const std::string text = ReadFile(path);
  return text.substr(0, text.find('\n'));
}

void Report(const StudyResults& results) {
  Table table{{"scan", "version", "expected", "named", "result"}, {}, 5};
  int wrong = 0;
  int named = 0;
  int good = 0;
  int left_alone = 0;
  for (const StudyRun& run : results.runs) {
    const auto figure = run.figures.find("right");
    const bool right = figure != run.figures.end() && figure->second > 0;
    const bool is_good = LabelOf(run.labels, "version") == "good";
    (is_good ? good : wrong) += 1;
    (is_good ? left_alone : named) += right ? 1 : 0;
    table.rows.push_back({LabelOf(run.labels, "scan"), LabelOf(run.labels, "version"),
                          LabelOf(run.labels, "expected"), FirstLine(run.folder / "check.txt"),
                          right ? "right" : "WRONG"});
  }
  table.rows.push_back({"all", "wrong versions", fmt::format("{}", wrong), fmt::format("{}", named),
                        "named rightly"});
  table.rows.push_back({"all", "good scans", fmt::format("{}", good), fmt::format("{}", left_alone),
                        "without complaint"});
  WriteTable(results.folder, results.stem, table);
}

}  // namespace

Study CheckStudy() {
  return {.name = "check",
          .summary = "Does check name what is wrong with a scan, and leave good ones alone?",
          .cases = Cases,
          .run = Run,
          .report = Report};
}

}  // namespace curvefusion
