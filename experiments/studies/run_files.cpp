#include "experiments/studies/run_files.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/csv_cell.h"
#include "experiments/studies/provenance.h"
#include "kernel/atomic_file.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFileName = "run.json";

Json MachineJson(const Provenance& program) {
  return {
      {"processor", program.processor}, {"cores", program.cores}, {"memory_gb", program.memory_gb}};
}

Json LabelsJson(const Labels& labels) {
  Json json = Json::object();
  for (const auto& [name, value] : labels) json[name] = value;
  return json;
}

// Throws nlohmann's exceptions for what is not there or of another type.
RunFile Parsed(const Json& json, const fs::path& folder) {
  RunFile file;
  for (const auto& [name, value] : json.at("labels").items()) {
    file.run.labels.emplace_back(name, value.get<std::string>());
  }
  file.run.seed = json.at("seed").get<uint64_t>();
  file.run.outcome = json.at("outcome").get<std::string>();
  file.run.message = json.at("message").get<std::string>();
  file.run.revision = json.at("revision").get<std::string>();
  file.run.folder = folder;
  file.run.figures = json.at("figures").get<Figures>();
  file.settings = json.at("settings").dump();
  return file;
}

std::string CsvHeader(const std::vector<StudyRun>& runs, const std::set<std::string>& figures) {
  std::string text;
  for (const auto& [name, value] : runs.front().labels) text += name + ",";
  text += "seed,outcome,message,revision";
  for (const std::string& figure : figures) text += "," + figure;
  return text + "\n";
}

std::string CsvRow(const StudyRun& run, const std::set<std::string>& figures) {
  std::string text;
  for (const auto& [name, value] : run.labels) text += CsvCell(value) + ",";
  text += fmt::format("{},{},{},{}", run.seed, run.outcome, CsvCell(run.message), run.revision);
  for (const std::string& figure : figures) {
    const auto found = run.figures.find(figure);
    text += found == run.figures.end() ? "," : fmt::format(",{}", found->second);
  }
  return text + "\n";
}

}  // namespace

void WriteRunFile(const fs::path& folder, const RunFile& file) {
  const Provenance program = ThisProgram();
  const Json json = {{"format", "curvefusion-run"},   {"labels", LabelsJson(file.run.labels)},
                     {"seed", file.run.seed},         {"outcome", file.run.outcome},
                     {"message", file.run.message},   {"version", program.version},
                     {"revision", file.run.revision}, {"machine", MachineJson(program)},
                     {"figures", file.run.figures},   {"settings", Json::parse(file.settings)}};
  const std::string text = json.dump(1);
  WriteStreamAtomically(folder / kFileName, [&](std::ostream& stream) { stream << text << "\n"; });
}

std::optional<RunFile> ReadRunFile(const fs::path& folder) {
  std::ifstream stream(folder / kFileName);
  if (!stream) return std::nullopt;
  try {
    return Parsed(Json::parse(stream), folder);
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;  // not one of ours, or of an older program: to be measured again
  }
}

void WriteRunsCsv(const fs::path& path, const std::vector<StudyRun>& runs) {
  if (runs.empty()) return;
  std::set<std::string> figures;
  for (const StudyRun& run : runs) {
    for (const auto& [name, value] : run.figures) figures.insert(name);
  }
  WriteStreamAtomically(path, [&](std::ostream& stream) {
    stream << CsvHeader(runs, figures);
    for (const StudyRun& run : runs) stream << CsvRow(run, figures);
  });
}

void WriteRunsJson(const fs::path& path, const std::vector<StudyRun>& runs) {
  if (runs.empty()) return;
  Json json = Json::array();
  for (const StudyRun& run : runs) {
    json.push_back({{"labels", LabelsJson(run.labels)},
                    {"seed", run.seed},
                    {"outcome", run.outcome},
                    {"message", run.message},
                    {"revision", run.revision},
                    {"figures", run.figures}});
  }
  WriteStreamAtomically(path, [&](std::ostream& stream) { stream << json.dump(1) << "\n"; });
}

}  // namespace curvefusion
