#include "tests/faults/program_run.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLongestRun = 300;  // seconds; most take one on a machine without other work

std::string Text(const fs::path& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

// Variables for fault_shim.cpp.
void SetVariables(const Disturbance& disturbance, const fs::path& log) {
  if (disturbance.kind.empty()) return;
  setenv("LD_PRELOAD", CURVEFUSION_FAULT_SHIM, 1);
  setenv("FAULT_KIND", disturbance.kind.c_str(), 1);
  setenv("FAULT_FIRST", std::to_string(disturbance.first).c_str(), 1);
  setenv("FAULT_COUNT", std::to_string(disturbance.count).c_str(), 1);
  setenv("FAULT_BYTES", std::to_string(disturbance.least_bytes).c_str(), 1);
  setenv("FAULT_ERRNO", std::to_string(disturbance.error).c_str(), 1);
  setenv("FAULT_LOG", log.c_str(), 1);
}

[[noreturn]] void BecomeProgram(const fs::path& folder, const std::vector<std::string>& arguments,
                                const Disturbance& disturbance, const fs::path& output,
                                const fs::path& log) {
  std::vector<std::string> words = {CURVEFUSION_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const int file = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  if (chdir(folder.c_str()) != 0) _exit(127);
  SetVariables(disturbance, log);
  execv(CURVEFUSION_PROGRAM, pointers.data());
  _exit(127);
}

double Seconds(const timespec& time) {
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// Of all threads of a process that runs; 0 where that is not told.
double CpuSecondsOf(pid_t process) {
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
  return Seconds(time);
}

// Waits for the process, which gets its signal once, and is killed where it runs for too long.
ProgramRun Await(pid_t process, const Disturbance& disturbance) {
  const auto start = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  ProgramRun run;
  int status = 0;
  rusage usage{};
  double sent = -1, cpu_sent = 0;
  const double longest = std::max(0.0, disturbance.signal_after) + kLongestRun;
  while (wait4(process, &status, WNOHANG, &usage) == 0) {
    if (seconds() > longest) kill(process, SIGKILL);
    if (sent < 0 && disturbance.signal_after >= 0 && seconds() > disturbance.signal_after) {
      cpu_sent = CpuSecondsOf(process);
      sent = seconds();
      kill(process, disturbance.signal);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  }
  run.seconds = seconds();
  if (sent >= 0) {
    run.after_signal = run.seconds - sent;
    run.cpu_after_signal = Seconds(usage.ru_utime) + Seconds(usage.ru_stime) - cpu_sent;
  }
  run.peak_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
  if (WIFEXITED(status)) run.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) run.signal = WTERMSIG(status);
  return run;
}

void ReadLog(const fs::path& path, ProgramRun& run) {
  std::ifstream log(path);
  for (std::string line; std::getline(log, line);) {
    if (line.starts_with("failed ")) run.failed = line.substr(7);
    if (line.starts_with("total ")) run.operations = std::stol(line.substr(6));
  }
}

// What a report says beside times and memory. A torn one is left as it is.
std::string LastingPart(const std::string& report) {
  auto json = nlohmann::ordered_json::parse(report, nullptr, false);
  if (json.is_discarded()) return report;
  for (const char* key : {"seconds", "seconds_per_30_frames", "peak_memory_bytes"}) json.erase(key);
  if (json.contains("mesh") && json["mesh"].is_object()) json["mesh"].erase("seconds");
  for (auto& stage : json["stages"]) {
    stage.erase("seconds");
    stage.erase("peak_memory_bytes");
  }
  return json.dump();
}

// The same of the page, whose data hold the report.
std::string LastingPartOfPage(const std::string& page) {
  const std::string begin = R"(<script type="application/json" id="data">)";
  const size_t first = page.find(begin);
  const size_t last = page.find("</script>", first);
  if (first == std::string::npos || last == std::string::npos || !page.ends_with("</html>\n")) {
    return page;
  }
  const size_t data = first + begin.size();
  auto json = nlohmann::ordered_json::parse(page.substr(data, last - data), nullptr, false);
  if (json.is_discarded()) return page;
  json["report"] = LastingPart(json["report"].dump());
  return page.substr(0, first) + json.dump() + page.substr(last);
}

// lib3MF makes new identifiers in every run: of an archive that is whole this is all to compare.
std::string WholeArchive(const std::string& bytes) {
  constexpr size_t kEnd = 22;  // bytes of a ZIP archive's last record (PKWARE, APPNOTE.TXT 4.3.16)
  const bool is_whole = bytes.size() > kEnd && bytes.starts_with("PK\x03\x04") &&
                        bytes.compare(bytes.size() - kEnd, 4, "PK\x05\x06") == 0;
  return is_whole ? "whole" : bytes;
}

// What a live run writes on its way tells how it goes at that moment: whole is all it need be.
bool IsWholeState(const fs::path& path) {
  return path.filename() == "state.json" && nlohmann::ordered_json::accept(Text(path));
}

// What should be the same in every run.
std::string Comparable(const fs::path& path) {
  const std::string bytes = Text(path);
  if (path.filename() == "report.json") return LastingPart(bytes);
  if (path.filename() == "report.html") return LastingPartOfPage(bytes);
  if (path.extension() == ".3mf") return WholeArchive(bytes);
  return bytes;
}

}  // namespace

ProgramRun RunProgram(const fs::path& folder, const std::vector<std::string>& arguments,
                      const Disturbance& disturbance) {
  const fs::path output = folder.string() + ".output.txt";
  const fs::path log = folder.string() + ".faults.txt";
  fs::remove(log);
  const pid_t process = fork();
  if (process == 0) BecomeProgram(folder, arguments, disturbance, output, log);
  ProgramRun run = Await(process, disturbance);
  ReadLog(log, run);
  run.output = Text(output);
  return run;
}

bool CanInjectFaults() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return false;
#else
  return true;
#endif
}

std::map<std::string, std::string> FilesBelow(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    if (entry.is_directory()) {
      files[name + "/"];
    } else if (!IsWholeState(entry.path())) {
      files[name] = Comparable(entry.path());
    }
  }
  return files;
}

}  // namespace curvefusion
