// Does `check` name what is wrong with a scan, and leave good ones alone? Random scans with one
// mistake each, good ones of other objects, rooms, sensors and trackers, and recordings.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <nlohmann/json.hpp>
#include <set>

#include "capture/check.h"
#include "capture/check_json.h"
#include "capture/detect_format.h"
#include "experiments/simulation/families/scan_draw.h"
#include "experiments/studies/check_verdict.h"
#include "experiments/studies/colour_reference.h"
#include "experiments/studies/good_versions.h"
#include "experiments/studies/recordings.h"
#include "experiments/studies/result_table.h"
#include "experiments/studies/studies.h"
#include "experiments/studies/wrong_versions.h"
#include "kernel/atomic_file.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

constexpr int kFrames = 60;  // of a scan to spoil: simulating one takes half a minute of a core
constexpr int kGoodFrames = 40;
constexpr int kQuickFrames = 40;
constexpr const char* kAsRecorded = "as_recorded";
constexpr const char* kNothing = "nothing";
constexpr const char* kRawColour = "colour-misregistered";

// Chosen: objects that fill the view and that hardly do, in rooms with and without furniture.
constexpr std::array<const char*, 5> kSpoiled = {"cage", "furnished", "tree", "rack", "cables"};

// A good scan in which one thing is not drawn but given.
struct GoodScan {
  const char* family;
  const char* pose_source = nullptr;
  const char* sensor = nullptr;
  bool is_raw = false;
};
constexpr std::array<GoodScan, 12> kGood = {{{"grid", "orbslam2"},
                                             {"trolley", "kinfu"},
                                             {"chair", "ptam"},
                                             {"net", "kitchen"},
                                             {"vine", "bundlefusion"},
                                             {"umbrella", "true"},
                                             {"wheel", nullptr, "d400"},
                                             {"scrolls", nullptr, "azure_kinect"},
                                             {"mixture", nullptr, "kinect_v2"},
                                             {"knot", nullptr, "sr300"},
                                             {"room", nullptr, nullptr, true},
                                             {"legs", "ptam", "primesense", true}}};
constexpr size_t kQuickGood = 2;

SimulationOptions Drawn(const std::string& family, uint64_t seed, int most_frames) {
  SimulationOptions scan = DrawScan(family, seed);
  scan.frames = std::min(scan.frames, most_frames);
  return scan;
}

SimulationOptions Drawn(const GoodScan& good, uint64_t seed) {
  SimulationOptions scan = Drawn(good.family, seed, kGoodFrames);
  if (good.pose_source != nullptr) scan.pose_source = good.pose_source;
  if (good.sensor != nullptr) {
    scan.sensor = good.sensor;
    scan.motion.standoff = 0.6;  // which all of them measure
  }
  if (good.is_raw) scan.color.registration = Registration::kRaw;
  return scan;
}

StudyCase CaseOf(const std::string& scan, const std::string& version, const std::string& expected,
                 uint64_t seed) {
  return {{{"scan", scan}, {"version", version}, {"expected", expected}}, seed, {}, Config(), {}};
}

// `expected` of a scan that is as it was recorded.
std::string ExpectedOf(const SimulationOptions& scan) {
  return scan.color.registration == Registration::kRaw ? kRawColour : kNothing;
}

// Takes its turn of some items: each comes to one of `turns`, or to all where there is one.
template <class Item>
std::vector<Item> InTurn(const std::vector<Item>& items, size_t turn, size_t turns) {
  std::vector<Item> mine;
  for (size_t i = turn % turns; i < items.size(); i += turns) mine.push_back(items[i]);
  return mine;
}

// The `turn`-th of the scans to spoil: between them these have every version once, five seeds all
// versions of all.
void AddSpoiledScan(const SimulationOptions& scan, const std::string& family, uint64_t seed,
                    size_t turn, size_t turns, std::vector<StudyCase>& cases) {
  std::vector<StudyCase> versions = {CaseOf(family, kAsRecorded, ExpectedOf(scan), seed)};
  for (const WrongVersion& version : InTurn(WrongVersions(), turn + seed, turns)) {
    versions.push_back(CaseOf(family, version.name, version.cause, seed));
  }
  for (const std::string& version :
       InTurn(GoodVersions(), turn + seed, std::min<size_t>(turns, 2))) {
    versions.push_back(CaseOf(family, version, kNothing, seed));
  }
  for (StudyCase& version : versions) {
    version.scan = scan;
    cases.push_back(version);
  }
}

std::vector<uint64_t> Seeds(const StudyRequest& request) {
  std::vector<uint64_t> seeds = SeedsOf(request);
  if (request.seeds == 0) seeds.resize(1);
  return seeds;
}

// A mistake of clocks needs a clock, one of the colour images' order a video.
bool IsPossible(const WrongVersion& version, const Sequence& recording) {
  if (version.cause == "clock-offset") return recording.format == "tum";
  return true;
}

// Of recordings those are spoiled that are simulated or called after a cable.
bool IsToSpoil(const fs::path& folder) {
  return fs::exists(folder / "truth" / "settings.json") ||
         folder.filename().string().find("cable") != std::string::npos;
}

void AddRecording(const fs::path& folder, std::vector<StudyCase>& cases) {
  const std::string name = folder.filename().string();
  const Sequence recording = ReadQuietly(folder);
  const auto reference = ReferenceOf(folder, recording.depth_camera);
  const bool is_raw = reference && !reference->is_told;
  std::vector<StudyCase> versions = {CaseOf(name, kAsRecorded, is_raw ? kRawColour : kNothing, 0)};
  for (const WrongVersion& version : WrongVersions()) {
    if (!IsToSpoil(folder) || !IsPossible(version, recording)) continue;
    versions.push_back(CaseOf(name, version.name, version.cause, 0));
  }
  for (StudyCase& version : versions) {
    version.recording = folder;
    cases.push_back(version);
  }
}

std::vector<StudyCase> Cases(const StudyRequest& request) {
  std::vector<StudyCase> cases;
  for (const uint64_t seed : Seeds(request)) {
    for (size_t i = 0; i < (request.quick ? kQuickGood : kGood.size()); ++i) {
      const SimulationOptions scan = Drawn(kGood[i], seed);
      cases.push_back(CaseOf(kGood[i].family, kAsRecorded, ExpectedOf(scan), seed));
      cases.back().scan = scan;
    }
    const size_t turns = request.quick ? 1 : kSpoiled.size();
    for (size_t turn = 0; turn < turns; ++turn) {
      const char* family = kSpoiled[turn];
      AddSpoiledScan(Drawn(family, seed, request.quick ? kQuickFrames : kFrames), family, seed,
                     turn, turns, cases);
    }
  }
  for (const fs::path& folder : RecordingsOf(request)) AddRecording(folder, cases);
  return cases;
}

bool IsGoodVersion(const std::string& version) {
  const std::vector<std::string> names = GoodVersions();
  return version == kAsRecorded || std::find(names.begin(), names.end(), version) != names.end();
}

double MedianStep(const Sequence& sequence) {
  std::vector<double> steps;
  for (size_t i = 1; i < sequence.frames.size(); ++i) {
    steps.push_back(sequence.frames[i].timestamp - sequence.frames[i - 1].timestamp);
  }
  const auto spread = SpreadOf(steps);
  return spread ? spread->median : 0;
}

// Writes the version where it is another than the scan itself.
CheckExpectation MakeVersion(const fs::path& scan, const std::string& version, fs::path& checked) {
  CheckExpectation expected;
  const Sequence given = ReadQuietly(scan);
  expected.frame_period = MedianStep(given);
  const auto reference = ReferenceOf(scan, given.depth_camera);
  expected.may_misplace_colour = reference && !reference->is_told;
  const fs::path folder = checked;
  if (version == kAsRecorded) {
    checked = scan;
    if (expected.may_misplace_colour) expected.mistake.cause = kRawColour;
  } else if (IsGoodVersion(version)) {
    WriteGoodVersion(scan, version, folder);
  } else {
    expected.mistake = WriteWrongVersion(scan, version, folder);
  }
  for (const SequenceFrame& frame : ReadQuietly(checked).frames) {
    expected.frame_names.push_back(frame.name);
  }
  return expected;
}

// How far the reported colour camera is from the true one.
void AddColourOffsets(const nlohmann::json& check, const fs::path& scan, Figures& figures) {
  const nlohmann::json& fit = check.at("colour_fit");
  if (fit.is_null() || !fit.at("is_misregistered").get<bool>()) return;
  const Sequence given = ReadQuietly(scan);
  const auto reference = ReferenceOf(scan, given.depth_camera);
  if (!reference) return;
  const nlohmann::json& camera = fit.at("color_camera");
  ColourReference fitted{
      {camera["width"], camera["height"], camera["fx"], camera["fy"], camera["cx"], camera["cy"]}};
  for (int axis = 0; axis < 3; ++axis) {
    fitted.T_color_depth.translation()[axis] = fit["T_color_depth"][axis][3].get<double>();
  }
  for (const double distance : {0.5, 0.8, 1.5}) {
    figures[fmt::format("colour_offset_px.{}m", distance)] =
        ColourOffset(given.depth_camera, fitted, *reference, distance);
  }
}

RunOutcome Run(const RunInput& input) {
  const fs::path& recording = input.study_case.recording;
  const fs::path& scan = recording.empty() ? input.scan : recording;
  fs::path checked = input.folder / "scan";
  const CheckExpectation expected =
      MakeVersion(scan, LabelOf(input.study_case.labels, "version"), checked);
  const std::clock_t start = std::clock();
  const std::string text = CheckJson(CheckSequence(checked, input.progress));
  RunOutcome outcome;
  outcome.figures["processor_seconds"] = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const nlohmann::json check = nlohmann::json::parse(text);
  const CheckVerdict verdict = JudgeCheck(check, expected);
  outcome.figures["right"] = verdict.is_right ? 1 : 0;
  AddColourOffsets(check, scan, outcome.figures);
  WriteBytesAtomically(input.folder / "check.json", text);
  WriteStreamAtomically(input.folder / "verdict.txt", [&](std::ostream& stream) {
    stream << verdict.named << "\n" << verdict.remarks << "\n";
  });
  fs::remove_all(input.folder / "scan");
  return outcome;
}

std::string Line(const fs::path& path, int number) {
  if (!fs::exists(path)) return "-";
  std::string text = ReadFile(path);
  for (int i = 0; i < number; ++i) text = text.substr(text.find('\n') + 1);
  return text.substr(0, text.find('\n'));
}

struct Count {
  int all = 0;
  int right = 0;
};

void Report(const StudyResults& results) {
  Table table{{"scan", "version", "expected", "named", "remarks", "result"}, {}, 6};
  Count wrong, good;
  for (const StudyRun& run : results.runs) {
    const auto figure = run.figures.find("right");
    const bool is_right = figure != run.figures.end() && figure->second > 0;
    Count& count = LabelOf(run.labels, "expected") == kNothing ? good : wrong;
    ++count.all;
    count.right += is_right ? 1 : 0;
    table.rows.push_back({LabelOf(run.labels, "scan"), LabelOf(run.labels, "version"),
                          LabelOf(run.labels, "expected"), Line(run.folder / "verdict.txt", 0),
                          Line(run.folder / "verdict.txt", 1), is_right ? "right" : "WRONG"});
  }
  const auto add = [&](const char* kind, const Count& count, const char* what) {
    table.rows.push_back(
        {"all", kind, "", "", "", fmt::format("{} of {} {}", count.right, count.all, what)});
  };
  add("with a mistake", wrong, "named rightly");
  add("good", good, "without complaint");
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
