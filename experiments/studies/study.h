#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/config.h"
#include "experiments/simulation/simulate.h"
#include "kernel/progress.h"

namespace curvefusion {

/// Which scans a study looks at: those on which constants may be chosen (seeds 1 to 99), those on
/// which is judged in the course of the work whether a choice carries (seeds 201 to 299), or those
/// kept for the final figures (seeds 101 to 199).
enum class Split { kTrain, kValidation, kTest };

/// "train", "validation", "test".
std::vector<std::string> SplitNames();
std::string SplitName(Split split);
/// Throws Error(kUsage) for another name.
Split SplitNamed(const std::string& name);

/// What the user asks of a study.
struct StudyRequest {
  bool quick = false;  ///< fewer frames, cases and seeds: at most five minutes on two cores
  std::vector<Profile> profiles = {Profile::kPaper, Profile::kBest};
  int seeds = 0;  ///< how many; 0 = 3, or 1 of a quick study
  Split split = Split::kTrain;
  std::vector<std::string> assignments;      ///< "section.key=value" for the config of every case
  std::vector<std::string> objects;          ///< objects or families; empty = those of the study
  std::string sensor;                        ///< of all random scans; empty = the drawn ones
  std::vector<std::filesystem::path> scans;  ///< folders of scans for `check` and `families`
  std::filesystem::path data;                ///< whose sim/ and real/ hold more for `families`
};

/// The seeds a request asks for.
std::vector<uint64_t> SeedsOf(const StudyRequest& request);

/// The objects a request asks for: otherwise the paper's eight, or two of a quick study. Throws
/// Error(kUsage) naming the nearest one for an object that cannot be simulated.
std::vector<std::string> ObjectsOf(const StudyRequest& request);

/// How many frames a study has of a scan.
struct FrameCounts {
  int full = 150;  ///< 30 a second
  int quick = 60;  ///< of the same path: a part of it would show less of the object. 30 frames, a
                   ///< bundle of the paper, then take longer than a second, and cameras drift more
};

/// The scan of an object that studies of the paper's objects look at: a Kinect V1 with the poses of
/// ORB-SLAM2.
SimulationOptions ObjectScan(const StudyRequest& request, const std::string& object, uint64_t seed,
                             const FrameCounts& frames = {});

/// The families of random scans a request asks for: otherwise all, or five of a quick study. Throws
/// Error(kUsage) naming the nearest one for a family that does not exist.
std::vector<std::string> FamiliesOf(const StudyRequest& request);

/// The random scan of a family that studies look at, in 60 frames at most for a quick study. Throws
/// Error(kUsage) like DrawScan.
SimulationOptions FamilyScan(const StudyRequest& request, const std::string& family, uint64_t seed);

/// The config of a case: the profile's, with the request's assignments, then `more`.
Config CaseConfig(const StudyRequest& request, Profile profile,
                  const std::vector<std::string>& more = {});

/// What tells a run from others besides its seed: {{"object", "cage"}, {"profile", "best"}}.
using Labels = std::vector<std::pair<std::string, std::string>>;

/// The value of a label; empty where there is none.
std::string LabelOf(const Labels& labels, const std::string& name);

/// One measurement to be made. Everything that decides its outcome stands here: a run is measured
/// again when any of it has changed.
struct StudyCase {
  Labels labels;
  uint64_t seed = 1;
  /// The scan to simulate, which `seed` gives; none where the study makes its own data.
  std::optional<SimulationOptions> scan;
  Config config;
  std::filesystem::path recording;  ///< of a study that measures scans which are there
};

/// "cage_best_s1": the labels' values and the seed, characters unfit for a file name replaced.
std::string CaseName(const StudyCase& study_case);

/// What was measured, by the column names of `curvefusion evaluate` ("raw.curves.5mm.f") and the
/// study's own. What has no value is left out.
using Figures = std::map<std::string, double>;

struct RunOutcome {
  bool found = true;  ///< false: nothing thin was found, an expected outcome
  Figures figures;
};

struct RunInput;

/// Measures one case.
using CaseMeasurement = std::function<RunOutcome(const RunInput&)>;

/// What a measurement is given.
struct RunInput {
  const StudyCase& study_case;
  std::filesystem::path scan;    ///< the simulated scan, with truth/; empty where it has none
  std::filesystem::path folder;  ///< for files to keep; it gets its final name only afterwards
  const Progress& progress;      ///< to be called now and then: throws once the user interrupts
  /// The whole method on the case's scan, for measurements that begin with it
  /// (RunnerOptions::reconstruct).
  CaseMeasurement reconstruct = {};
};

/// A run that has been measured, or has failed.
struct StudyRun {
  Labels labels;
  uint64_t seed = 1;
  std::string outcome;           ///< "done", "nothing found" or "failed"
  std::string message;           ///< of a failed run
  std::string revision;          ///< of the program that measured it
  std::filesystem::path folder;  ///< its files
  Figures figures;
};

/// All runs of a study, in the order of its cases.
struct StudyResults {
  std::filesystem::path folder;  ///< where tables and figures go
  std::string stem;              ///< what their names begin with: "objects_train"
  std::vector<StudyRun> runs;
};

/// A study: which cases it has, how one is measured, and what is made of all. To add one, write a
/// file that fills such a struct and name its function in studies.cpp.
struct Study {
  std::string name;
  std::string summary;  ///< one sentence for --help
  std::function<std::vector<StudyCase>(const StudyRequest&)> cases;
  /// Measures one case; RunInput::reconstruct where it is empty. Called from several threads at
  /// once where there is more than one job.
  CaseMeasurement run;
  /// Writes tables and figures (result_table.h, gnuplot.h), also where runs have failed.
  std::function<void(const StudyResults&)> report;
};

}  // namespace curvefusion
