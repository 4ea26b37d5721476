#include "experiments/sweeps/cell_measurement.h"

#include <cmath>
#include <new>
#include <system_error>

#include "experiments/simulation/scan_settings.h"
#include "experiments/studies/provenance.h"
#include "experiments/studies/reconstruction_run.h"
#include "experiments/studies/run_files.h"
#include "experiments/sweeps/sweep_plan.h"
#include "kernel/error.h"
#include "kernel/free_space.h"
#include "kernel/partial_folder.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

StudyCase CaseOf(const SweepCell& cell) {
  return {{{"object", cell.object},
           {"sensor", cell.sensor},
           {"poses", cell.poses},
           {"profile", ProfileName(cell.profile)},
           {"setting", SettingName(cell)}},
          cell.seed,
          {},
          ReadConfig({cell.profile, {}, cell.settings}),
          {}};
}

// What the same program would do again, whenever and wherever it is run.
bool IsLasting(const Error& error) {
  return error.kind() == ErrorKind::kBadInput || error.kind() == ErrorKind::kUsage;
}

void RequireScanOf(const SweepCell& cell, const fs::path& scan) {
  if (fs::absolute(scan).lexically_normal().filename() == cell.scan) return;
  throw Error(ErrorKind::kUsage,
              scan.string() + ": is not the scan of the cell, which is " + cell.scan);
}

StudyRun Measured(const StudyCase& study_case, const CaseMeasurement& measure,
                  const RunInput& input) {
  StudyRun run{study_case.labels, study_case.seed, "failed", "", ThisProgram().revision, {}, {}};
  try {
    const RunOutcome outcome = measure(input);
    run.outcome = outcome.found ? "done" : "nothing found";
    run.figures = outcome.figures;
    std::erase_if(run.figures, [](const auto& f) { return !std::isfinite(f.second); });
  } catch (const Error& error) {
    if (!IsLasting(error)) throw;
    run.message = error.what();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const fs::filesystem_error&) {
    throw;
  } catch (const std::exception& error) {
    run.message = error.what();
  }
  return run;
}

RunOutcome RunAsCell(const RunInput& input, const CacheFolders& folders) {
  if (!input.study_case.scan) return ReconstructAndEvaluate(input);
  const SweepCell cell = CellOfCase(input.study_case);
  fs::path result = FinishedResult(folders, cell);
  if (result.empty()) {
    WriteCell(StoreOf(folders), cell);
    result = ResultFolder(StoreOf(folders), cell);
    MeasureCell(cell, input.scan, result, input.progress);
  }
  const auto file = ReadRunFile(result);
  if (!file) {
    throw Error(ErrorKind::kBadInput, (result / "run.json").string() +
                                          ": cannot be read; remove its folder, and the cell is "
                                          "measured again");
  }
  if (file->run.outcome == "failed") throw Error(ErrorKind::kBadInput, file->run.message);
  for (const fs::directory_entry& entry : fs::directory_iterator(result)) {
    if (entry.path().filename() == "run.json") continue;
    fs::copy_file(entry.path(), input.folder / entry.path().filename());
  }
  return {file->run.outcome == "done", file->run.figures};
}

}  // namespace

CellOutcome MeasureCell(const SweepCell& cell, const fs::path& scan, const fs::path& result,
                        const Progress& progress, int shards) {
  if (const auto earlier = ReadRunFile(result)) {
    return {earlier->run.outcome, earlier->run.message};
  }
  RequireScanOf(cell, scan);
  RequireFreeSpace(result, kCellBytes);
  PartialFolder partial(result);
  const StudyCase study_case = CaseOf(cell);
  const CaseMeasurement measure = [&](const RunInput& input) {
    return shards > 0 ? MergeAndEvaluate(input, CellShards(result), shards)
                      : ReconstructAndEvaluate(input);
  };
  const StudyRun run = Measured(study_case, measure, {study_case, scan, partial.path(), progress});
  WriteRunFile(partial.path(), {run, CellSettings(cell)});
  if (!ReadRunFile(result)) partial.Finish();
  std::error_code stays;
  fs::remove_all(CellShards(result), stays);
  return {run.outcome, run.message};
}

std::string MeasureCellShard(const SweepCell& cell, const fs::path& scan, const fs::path& result,
                             ShardNumber shard, const Progress& progress) {
  if (ReadRunFile(result)) return {};
  RequireScanOf(cell, scan);
  const StudyCase study_case = CaseOf(cell);
  try {
    MeasureShard({study_case, scan, CellShards(result), progress}, shard);
  } catch (const Error& error) {
    if (!IsLasting(error)) throw;
    return error.what();
  }
  return {};
}

CaseMeasurement MeasurementByCells(const CacheFolders& folders) {
  return [folders](const RunInput& input) { return RunAsCell(input, folders); };
}

void MakeSweepScan(const fs::path& settings, const fs::path& folder, const Progress& progress) {
  const auto is_there = [&] { return fs::exists(folder / "truth" / "settings.json"); };
  if (is_there()) return;
  try {
    SimulateScan(ReadScanSettings(settings), folder, progress);
  } catch (const Error&) {
    if (!is_there()) throw;
  }
}

}  // namespace curvefusion
