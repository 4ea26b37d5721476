#include "experiments/sweeps/sweep_plan.h"

#include <nlohmann/json.hpp>

#include "experiments/simulation/scan_settings.h"
#include "experiments/studies/provenance.h"
#include "experiments/studies/scan_cache.h"
#include "experiments/sweeps/snakefile.h"
#include "kernel/atomic_file.h"
#include "kernel/error.h"
#include "kernel/file_set.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kPlanName = "plan.json";
constexpr const char* kFormat = "curvefusion-sweep";

Json CellJson(const SweepCell& cell) {
  return {{"cell", cell.key},          {"object", cell.object},
          {"seed", cell.seed},         {"sensor", cell.sensor},
          {"poses", cell.poses},       {"profile", ProfileName(cell.profile)},
          {"settings", cell.settings}, {"scan", cell.scan}};
}

std::string PlanText(const SweepPlan& plan, const fs::path& program) {
  Json caches = Json::array();
  for (const fs::path& cache : plan.caches) caches.push_back(cache.string());
  Json cells = Json::array();
  for (const SweepCell& cell : plan.cells) cells.push_back(CellJson(cell));
  return Json({{"format", kFormat},
               {"version", 1},
               {"method", plan.method},
               {"program", program.string()},
               {"threads", plan.threads},
               {"memory_mb", plan.memory_mb},
               {"shards", plan.shards},
               {"caches", caches},
               {"cells", cells}})
             .dump(1) +
         "\n";
}

SweepCell ParsedCell(const Json& json) {
  SweepCell cell;
  json.at("cell").get_to(cell.key);
  json.at("object").get_to(cell.object);
  json.at("seed").get_to(cell.seed);
  json.at("sensor").get_to(cell.sensor);
  json.at("poses").get_to(cell.poses);
  cell.profile = ProfileNamed(json.at("profile").get<std::string>());
  json.at("settings").get_to(cell.settings);
  json.at("scan").get_to(cell.scan);
  return cell;
}

// Throws nlohmann's exceptions for what is not there or of another type.
SweepPlan ParsedPlan(const Json& json, const fs::path& folder) {
  SweepPlan plan;
  plan.folder = folder;
  json.at("method").get_to(plan.method);
  json.at("threads").get_to(plan.threads);
  json.at("memory_mb").get_to(plan.memory_mb);
  plan.shards = json.value("shards", 1);
  for (const Json& cache : json.at("caches")) plan.caches.emplace_back(cache.get<std::string>());
  for (const Json& cell : json.at("cells")) plan.cells.push_back(ParsedCell(cell));
  return plan;
}

}  // namespace

SweepPlan WriteSweepPlan(const fs::path& study, const fs::path& folder,
                         const std::vector<fs::path>& caches, const fs::path& program) {
  const SweepRequest request = ReadSweepRequest(study);
  const std::string study_text = ReadFile(study);
  const SweepCells cells = CellsOf(request);
  SweepPlan plan{{folder, {}},      MethodVersion(), request.threads,
                 request.memory_mb, request.shards,  cells.cells};
  for (const fs::path& cache : caches) plan.caches.push_back(fs::absolute(cache));
  for (const SweepCell& cell : plan.cells) WriteCell(folder, cell);
  fs::create_directories(folder / "scans");
  for (const SimulationOptions& scan : cells.scans) {
    WriteBytesAtomically(ScanFolder(folder / "scans", scan).string() + ".json", ScanSettings(scan));
  }
  WriteFilesTogether(folder, {"study.toml", "Snakefile", kPlanName}, [&](const fs::path& files) {
    WriteBytesAtomically(files / "study.toml", study_text);
    WriteBytesAtomically(files / "Snakefile", kSnakefile);
    WriteBytesAtomically(files / kPlanName, PlanText(plan, program));
  });
  return plan;
}

SweepPlan ReadSweepPlan(const fs::path& folder) {
  const fs::path path = folder / kPlanName;
  if (!fs::exists(path)) {
    throw Error(ErrorKind::kBadInput, folder.string() +
                                          ": holds no sweep; make one with `curvefusion sweep "
                                          "plan STUDY.toml -o " +
                                          folder.string() + "`");
  }
  try {
    return ParsedPlan(Json::parse(ReadFile(path)), folder);
  } catch (const nlohmann::json::exception& error) {
    throw Error(ErrorKind::kBadInput,
                path.string() + ": is no plan of a sweep (" + error.what() + "); plan it again");
  }
}

void WriteCell(const fs::path& root, const SweepCell& cell) {
  const fs::path folder = ResultFolder(root, cell).parent_path();
  fs::create_directories(folder);
  WriteBytesAtomically(folder / "params.toml", ParamsToml(cell));
}

fs::path ResultFolder(const fs::path& root, const SweepCell& cell) {
  return root / "cells" / cell.key / "result";
}

fs::path FinishedResult(const CacheFolders& folders, const SweepCell& cell) {
  return FinishedIn(folders, ResultFolder({}, cell), "run.json");
}

}  // namespace curvefusion
