#include "experiments/studies/study_runner.h"

#include <cmath>
#include <cstdint>
#include <exception>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "experiments/simulation/scan_settings.h"
#include "experiments/studies/case_settings.h"
#include "experiments/studies/gnuplot.h"
#include "experiments/studies/provenance.h"
#include "experiments/studies/reconstruction_run.h"
#include "experiments/studies/run_files.h"
#include "experiments/studies/scan_cache.h"
#include "kernel/error.h"
#include "kernel/free_space.h"
#include "kernel/partial_folder.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

constexpr const char* kDone = "done";
constexpr const char* kNothing = "nothing found";
constexpr const char* kFailed = "failed";

// JSON has neither NaN nor infinity: such a figure is one without a value.
Figures FiniteOnly(Figures figures) {
  std::erase_if(figures, [](const auto& figure) { return !std::isfinite(figure.second); });
  return figures;
}

void CheckNames(const Study& study, const std::vector<StudyCase>& cases) {
  std::set<std::string> names;
  for (const StudyCase& study_case : cases) {
    if (names.insert(CaseName(study_case)).second) continue;
    throw Error(ErrorKind::kUsage, "study " + study.name + ": two cases are called " +
                                       CaseName(study_case) + "; their labels must differ");
  }
}

// A run that was measured with the same settings and has not failed.
std::optional<RunFile> FinishedRun(const Study& study, const StudyRequest& request,
                                   const fs::path& folder, const StudyCase& study_case) {
  std::optional<RunFile> file = ReadRunFile(RunFolder(study, request, folder, study_case));
  const bool finished =
      file && file->run.outcome != kFailed && file->settings == CaseSettings(study_case);
  return finished ? file : std::nullopt;
}

// Cases that share a scan: it is simulated once, then they are measured one after the other.
struct ScanGroup {
  const SimulationOptions* scan = nullptr;  // none: the cases make their own data
  std::vector<size_t> cases;                // to be measured
};

// Counts frames that are simulated or measured, and hands interruptions on from any thread.
class FrameCounter {
 public:
  FrameCounter(const Progress& progress, std::string stage, int64_t total)
      : progress_(progress), stage_(std::move(stage)), total_(total) {}

  void Advance(int64_t frames) {
    const std::lock_guard<std::mutex> lock(mutex_);
    done_ += frames;
    progress_(stage_, done_, total_);
  }

  // The progress of a single case: it does not count, as stages tell no share of the whole, but
  // may end the study.
  Progress Within() {
    return [this](std::string_view, int64_t, int64_t) { Advance(0); };
  }

  // The progress of a scan that is simulated frame by frame.
  Progress Simulating() {
    return [this, counted = int64_t{0}](std::string_view, int64_t frame, int64_t) mutable {
      Advance(frame - counted);
      counted = frame;
    };
  }

 private:
  const Progress& progress_;
  std::string stage_;
  int64_t total_;
  std::mutex mutex_;
  int64_t done_ = 0;
};

// One call of RunStudy.
class StudyRunner {
 public:
  StudyRunner(const Study& study, const StudyRequest& request, const fs::path& folder,
              const RunnerOptions& options, const std::vector<StudyCase>& cases)
      : study_(study),
        request_(request),
        folder_(folder),
        options_(options),
        cases_(cases),
        scans_{folder, options.caches},
        runs_(cases.size()) {}

  // Takes over what is finished; returns the rest, grouped by scans.
  std::vector<ScanGroup> Pending();

  void Measure(const std::vector<ScanGroup>& groups, const Progress& progress);

  std::vector<StudyRun> TakeRuns() { return std::move(runs_); }

 private:
  bool IsSimulated(const ScanGroup& group) const;
  std::uintmax_t BytesOf(const std::vector<ScanGroup>& groups) const;
  void MeasureGroup(const ScanGroup& group, FrameCounter& counter);
  void MeasureCase(size_t index, const fs::path& scan, FrameCounter& counter);
  void RecordFailure(size_t index, const std::string& message);

  const Study& study_;
  const StudyRequest& request_;
  const fs::path& folder_;
  const RunnerOptions& options_;
  const std::vector<StudyCase>& cases_;
  const CacheFolders scans_;
  const std::string revision_ = ThisProgram().revision;
  std::vector<StudyRun> runs_;
};

std::vector<ScanGroup> StudyRunner::Pending() {
  std::vector<ScanGroup> groups;
  std::map<std::string, size_t> group_of_scan;
  for (size_t i = 0; i < cases_.size(); ++i) {
    const auto file = FinishedRun(study_, request_, folder_, cases_[i]);
    if (file && !(options_.remeasure && file->run.revision != revision_)) {
      runs_[i] = file->run;
      continue;
    }
    const auto& scan = cases_[i].scan;
    const std::string key = scan ? ScanSettings(*scan) : "none " + std::to_string(i);
    const auto [group, is_new] = group_of_scan.emplace(key, groups.size());
    if (is_new) groups.push_back({scan ? &*scan : nullptr, {}});
    groups[group->second].cases.push_back(i);
  }
  return groups;
}

void StudyRunner::Measure(const std::vector<ScanGroup>& groups, const Progress& progress) {
  int64_t total = 0;
  for (const ScanGroup& group : groups) {
    if (!IsSimulated(group)) total += group.scan->frames;
    for (const size_t i : group.cases) total += FramesOf(cases_[i]);
  }
  RequireFreeSpace(folder_, BytesOf(groups));
  FrameCounter counter(progress, StageOf(study_), total);
  std::mutex mutex;
  size_t next = 0;
  std::exception_ptr failure;
  const auto work = [&] {
    while (true) {
      size_t mine;
      {
        const std::lock_guard<std::mutex> lock(mutex);
        if (failure || next == groups.size()) return;
        mine = next++;
      }
      try {
        MeasureGroup(groups[mine], counter);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        if (!failure) failure = std::current_exception();
      }
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < options_.jobs; ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

// Whether the group needs no scan any more.
bool StudyRunner::IsSimulated(const ScanGroup& group) const {
  return group.scan == nullptr ||
         !FinishedScan(scans_, ScanFolder({}, *group.scan).string()).empty();
}

// What the scans and runs will take on the disk at most.
std::uintmax_t StudyRunner::BytesOf(const std::vector<ScanGroup>& groups) const {
  // Chosen: five times the result of a wire cube, whose files take 1.5 MB.
  constexpr std::uintmax_t kRunBytes = 8u << 20;
  std::uintmax_t bytes = 0;
  for (const ScanGroup& group : groups) {
    if (!IsSimulated(group)) bytes += ScanBytes(*group.scan);
    bytes += kRunBytes * group.cases.size();
  }
  return bytes;
}

void StudyRunner::MeasureGroup(const ScanGroup& group, FrameCounter& counter) {
  fs::path scan;
  if (group.scan != nullptr) {
    try {
      scan = CachedScan(scans_, *group.scan, counter.Simulating());
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::kInterrupted) throw;
      for (const size_t i : group.cases) RecordFailure(i, error.what());
      return;
    }
  }
  for (const size_t i : group.cases) MeasureCase(i, scan, counter);
}

void StudyRunner::MeasureCase(size_t index, const fs::path& scan, FrameCounter& counter) {
  const StudyCase& study_case = cases_[index];
  const fs::path run_folder = RunFolder(study_, request_, folder_, study_case);
  try {
    PartialFolder partial(run_folder);
    const Progress within = counter.Within();
    const CaseMeasurement& measure = study_.run ? study_.run : options_.reconstruct;
    const RunOutcome outcome =
        measure({study_case, scan, partial.path(), within, options_.reconstruct});
    runs_[index] = {study_case.labels, study_case.seed, outcome.found ? kDone : kNothing, "",
                    revision_,         run_folder,      FiniteOnly(outcome.figures)};
    WriteRunFile(partial.path(), {runs_[index], CaseSettings(study_case)});
    partial.Finish();
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInterrupted) throw;
    RecordFailure(index, error.what());
  } catch (const std::exception& error) {
    RecordFailure(index, error.what());
  }
  counter.Advance(FramesOf(study_case));
}

void StudyRunner::RecordFailure(size_t index, const std::string& message) {
  const StudyCase& study_case = cases_[index];
  const fs::path run_folder = RunFolder(study_, request_, folder_, study_case);
  runs_[index] = {study_case.labels, study_case.seed, kFailed, message, revision_, run_folder, {}};
  PartialFolder partial(run_folder);
  WriteRunFile(partial.path(), {runs_[index], CaseSettings(study_case)});
  partial.Finish();
}

}  // namespace

std::string StudyStem(const Study& study, const StudyRequest& request) {
  return study.name + "_" + SplitName(request.split) + (request.quick ? "_quick" : "");
}

fs::path RunFolder(const Study& study, const StudyRequest& request, const fs::path& folder,
                   const StudyCase& study_case) {
  return folder / "runs" / StudyStem(study, request) / CaseName(study_case);
}

StudyPlan PlanStudy(const Study& study, const StudyRequest& request, const fs::path& folder) {
  StudyPlan plan;
  plan.cases = study.cases(request);
  CheckNames(study, plan.cases);
  const std::string revision = ThisProgram().revision;
  for (const StudyCase& study_case : plan.cases) {
    const auto file = ReadRunFile(RunFolder(study, request, folder, study_case));
    if (!file || file->run.outcome == kFailed) continue;
    const bool same = file->settings == CaseSettings(study_case);
    plan.finished += same ? 1 : 0;
    plan.other_settings += same ? 0 : 1;
    plan.other_revision += same && file->run.revision != revision ? 1 : 0;
  }
  return plan;
}

StudyResults FinishedRuns(const Study& study, const StudyRequest& request, const fs::path& folder) {
  StudyResults results{folder, StudyStem(study, request), {}};
  for (const StudyCase& study_case : PlanStudy(study, request, folder).cases) {
    const auto file = FinishedRun(study, request, folder, study_case);
    if (file) results.runs.push_back(file->run);
  }
  return results;
}

int FramesOf(const StudyCase& study_case) { return study_case.scan ? study_case.scan->frames : 1; }

std::string StageOf(const Study& study) { return study.name + ", frames"; }

StudyResults RunStudy(const Study& study, const StudyRequest& request, const fs::path& folder,
                      const RunnerOptions& options, const Progress& progress) {
  const StudyPlan plan = PlanStudy(study, request, folder);
  if (study.report) RequireGnuplot();
  StudyRunner runner(study, request, folder, options, plan.cases);
  runner.Measure(runner.Pending(), progress);
  StudyResults results{folder, StudyStem(study, request), runner.TakeRuns()};
  WriteRunsCsv(folder / (results.stem + ".csv"), results.runs);
  WriteRunsJson(folder / (results.stem + ".json"), results.runs);
  if (study.report) study.report(results);
  return results;
}

}  // namespace curvefusion
