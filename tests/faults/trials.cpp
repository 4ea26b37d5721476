#include "tests/faults/trials.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

constexpr int kResourceExit = 5;
constexpr int kInterruptedExit = 130;

// A Y of three wires 8 mm thick: the smallest object that has everything, a junction too.
std::string ObjectJson(double size) {
  std::string nodes = R"({"position":[0,0,0]})";
  std::string edges;
  const double ends[3][3] = {{size, 0, size}, {-size, 0, size}, {0, 0, -size}};
  for (int i = 0; i < 3; ++i) {
    const std::string end = fmt::format("[{},{},{}]", ends[i][0], ends[i][1], ends[i][2]);
    nodes += fmt::format(R"(,{{"position":{}}})", end);
    edges += fmt::format(R"({}{{"nodes":[0,{}],"points":[[0,0,0],{}],"radius":0.004}})",
                         i == 0 ? "" : ",", i + 1, end);
  }
  return fmt::format(
      R"({{"format":"curvefusion-skeleton","version":1,"units":"m","nodes":[{}],"edges":[{}]}})",
      nodes, edges);
}

// Points on a ring of wire.
std::string CloudText(double size) {
  std::string text;
  for (int i = 0; i < 2000; ++i) {
    const double along = 0.01 * i, around = 2.4 * i;  // no two points alike
    const double r = size + 0.004 * std::cos(around);
    text += fmt::format("{:.6f} {:.6f} {:.6f}\n", r * std::cos(along), r * std::sin(along),
                        0.004 * std::sin(around));
  }
  return text;
}

// Is `found` the result without the tubes, which could not be made, told by the report and its
// page?
bool IsResultWithoutTubes(const Files& found, const Files& result) {
  if (!result.contains("out/mesh.ply") || !found.contains("out/report.json") ||
      !found.contains("out/report.html")) {
    return false;
  }
  Files rest = result;
  rest.erase("out/mesh.ply");
  for (const char* name : {"out/report.json", "out/report.html"}) rest[name] = found.at(name);
  return found == rest && rest["out/report.json"].ends_with("}") &&
         rest["out/report.html"].ends_with("</html>\n");
}

bool IsTemporary(const std::string& name) {
  return name.find(".partial-") != std::string::npos || name.ends_with(".lock");
}

// The first, or nothing.
std::string TemporaryOf(const Files& files) {
  for (const auto& [name, bytes] : files) {
    if (IsTemporary(name)) return name;
  }
  return "";
}

// A folder that was made and stayed empty harms nobody.
Files WithoutEmptyFolder(const Files& found, const Files& before) {
  const bool is_empty = before.empty() && found.size() == 1 && found.contains("out/");
  return is_empty ? Files{} : found;
}

}  // namespace

std::vector<WritingCommand> WritingCommands() {
  std::vector<WritingCommand> commands = {
      {"reconstruct", {"reconstruct", "@/scan", "-o", "out", "--threads", "1"}},
      {"shard",
       {"reconstruct", "@/scan", "-o", "out", "--shard", "1/1", "--force", "--threads", "1"}},
      {"live", {"live", "@/scan", "-o", "out", "--rate", "1000", "--threads", "1"}},
      {"simulate",
       {"simulate", "@/object.json", "-o", "out", "--frames", "1", "--threads", "1", "--sensor",
        "ideal"},
       false},
      {"contract", {"contract", "@/cloud.xyz", "-o", "out/curves.json", "--threads", "1"}},
      {"evaluate",
       {"evaluate", "@/object.json", "--truth", "@/object.json", "--json", "out/scores.json",
        "--threads", "1"}}};
  for (const std::string format : {"ply", "obj", "stl", "glb", "3mf"}) {
    commands.push_back({"mesh_" + format,
                        {"mesh", "@/object.json", "-o", "out/tubes." + format, "--threads", "1"}});
  }
  for (const std::string format : {"json", "graphml", "ply", "obj", "swc", "dxf", "svg", "usda"}) {
    commands.push_back(
        {"graph_" + format,
         {"graph", "@/object.json", "--convert", "out/curves." + format, "--threads", "1"}});
  }
  for (const std::string format : {"dxf", "usda", "step"}) {
    commands.push_back({"fit_" + format,
                        {"graph", "@/object.json", "--fit", "0.5", "--convert",
                         "out/curves." + format, "--threads", "1"}});
  }
  commands.push_back(
      {"cut_list", {"graph", "@/object.json", "--cut-list", "out/wires.csv", "--threads", "1"}});
  return commands;
}

WritingCommand CommandNamed(const std::string& name) {
  for (const WritingCommand& command : WritingCommands()) {
    if (command.name == name) return command;
  }
  throw std::runtime_error("no command " + name);
}

TrialFolder::TrialFolder()
    : folder_(fs::temp_directory_path() / fmt::format("curvefusion_faults_{}", getpid())),
      trial_(folder_ / "trial") {
  WriteInputs("inputs", 0.15);
  WriteInputs("earlier", 0.12);
}

TrialFolder::~TrialFolder() { fs::remove_all(folder_); }

void TrialFolder::WriteInputs(const std::string& name, double size) const {
  const fs::path inputs = folder_ / name;
  fs::create_directories(inputs);
  std::ofstream(inputs / "object.json") << ObjectJson(size);
  std::ofstream(inputs / "cloud.xyz") << CloudText(size);
  const ProgramRun run =
      RunProgram(inputs, {"simulate", "object.json", "-o", "scan", "--sensor", "ideal", "--poses",
                          "true", "--frame-rate", "10", "--frames", "4", "--quiet"});
  if (run.exit_code != 0) throw std::runtime_error("no scan to try with: " + run.output);
}

ProgramRun TrialFolder::RunOn(const std::string& inputs, const WritingCommand& command,
                              const Disturbance& disturbance) const {
  std::vector<std::string> arguments = command.arguments;
  for (std::string& argument : arguments) {
    if (argument.starts_with("@")) argument = "../" + inputs + argument.substr(1);
  }
  return RunProgram(trial_, arguments, disturbance);
}

ProgramRun TrialFolder::Run(const WritingCommand& command, const Disturbance& disturbance) const {
  return RunOn("inputs", command, disturbance);
}

References TrialFolder::MakeReferences(const WritingCommand& command) const {
  References references;
  for (const auto& [inputs, files] :
       {std::pair("earlier", &references.earlier), std::pair("inputs", &references.result)}) {
    Prepare({});
    const ProgramRun run = RunOn(inputs, command, {});
    if (run.exit_code != 0) throw std::runtime_error(command.name + " fails: " + run.output);
    *files = Found();
  }
  if (!command.replaces) references.earlier.clear();
  return references;
}

void TrialFolder::Prepare(const Files& files) const {
  fs::remove_all(trial_);
  fs::create_directories(trial_);
  for (const auto& [name, bytes] : files) {
    if (name.ends_with("/")) {
      fs::create_directories(trial_ / name);
    } else {
      std::ofstream(trial_ / name, std::ios::binary) << bytes;
    }
  }
}

double TrialFolder::Duration(const WritingCommand& command) const {
  Prepare({});
  return Run(command).seconds;
}

std::string FaultOf(const ProgramRun& run, const Files& found, const Files& before,
                    const References& references) {
  // The destructor of lib3MF's writer throws where it or zlib finds no memory: the program ends as
  // if it were killed.
  const auto says = [&run](const char* what) { return run.output.find(what) != std::string::npos; };
  const bool writes_3mf = references.result.contains("out/tubes.3mf");
  if (run.signal == SIGABRT && writes_3mf &&
      (says("NMR::CNMRException") || says("std::bad_alloc"))) {
    return KillFaultOf(found, references);
  }
  if (run.signal != 0) return fmt::format("signal {}", run.signal);
  if (run.exit_code == 0) {
    if (found == references.result) return "";
    return "exit code 0, but " + Difference(found, references.result);
  }
  if (run.exit_code != kResourceExit) return fmt::format("exit code {}", run.exit_code);
  if (const std::string left = TemporaryOf(found); !left.empty()) return left + " is left";
  const Files kept = WithoutEmptyFolder(found, before);
  if (kept == before || kept == references.result) return "";
  if (IsResultWithoutTubes(kept, references.result)) return "";
  return fmt::format("from before: {}; of the result: {}", Difference(kept, before),
                     Difference(kept, references.result));
}

std::string InterruptFaultOf(const ProgramRun& run, const Files& found, const Files& before,
                             const References& references) {
  // Before the program has begun to catch signals: a shell shows such an end as 130, too.
  const bool is_interrupted =
      run.exit_code == kInterruptedExit || run.signal == SIGINT || run.signal == SIGTERM;
  if (!is_interrupted && run.exit_code != 0) {
    return fmt::format("exit code {}, signal {}", run.exit_code, run.signal);
  }
  if (const std::string left = TemporaryOf(found); !left.empty()) return left + " is left";
  const Files& expected = is_interrupted ? before : references.result;
  const Files kept = WithoutEmptyFolder(found, before);
  if (kept == expected) return "";
  return fmt::format("exit code {}, but {}", run.exit_code, Difference(kept, expected));
}

std::string KillFaultOf(const Files& found, const References& references) {
  const auto is_of = [](const Files& files, const std::string& name, const std::string& bytes) {
    return files.contains(name) && files.at(name) == bytes;
  };
  for (const auto& [name, bytes] : found) {
    if (IsTemporary(name)) continue;
    if (is_of(references.earlier, name, bytes) || is_of(references.result, name, bytes)) continue;
    return name + " is neither the earlier one nor complete";
  }
  return "";
}

std::string Difference(const Files& found, const Files& expected) {
  for (const auto& [name, bytes] : expected) {
    if (!found.contains(name)) return name + " is missing";
    if (found.at(name) != bytes) return name + " has other bytes";
  }
  for (const auto& [name, bytes] : found) {
    if (!expected.contains(name)) return name + " should not be there";
  }
  return "none";
}

bool TriesEverything() {
  const char* effort = std::getenv("CURVEFUSION_FAULTS");
  return effort != nullptr && std::string(effort) == "all";
}

}  // namespace curvefusion
