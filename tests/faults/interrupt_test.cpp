// Runs are interrupted at random times: they end at once, and leave what lay there before.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/faults/trials.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

// What a user is promised. On a machine with other work the clock goes on while the run waits for a
// core, so processor seconds are held to it, and the clock only to a wide limit: a run that sleeps
// takes none.
constexpr double kPromised = 0.5;
constexpr double kLongestWait = 5;
constexpr int kManyInterrupts = 40;     // of `./run faults`
constexpr int kInterruptsToRerun = 10;  // after so many a run is left alone
constexpr uint32_t kSeed = 5;

struct InterruptedCommand {
  WritingCommand command;
  int few = 2;  // interrupts of ctest
  // The first SIGINT of live only ends its capture.
  int signal = SIGINT;
  // What a study has measured stays, and the same command goes on from there.
  bool keeps_parts = false;
};

// To print parameters.
void PrintTo(const InterruptedCommand& command, std::ostream* stream) {
  *stream << command.command.name;
}

std::vector<InterruptedCommand> InterruptedCommands() {
  std::vector<InterruptedCommand> commands = {
      {CommandNamed("live"), 2, SIGTERM},
      {CommandNamed("simulate")},
      {{"reconstruct", {"reconstruct", "@/long_scan", "-o", "out", "--threads", "1"}}},
      {{"reconstruct_parallel", {"reconstruct", "@/long_scan", "-o", "out", "--threads", "2"}}},
      {{"contract", {"contract", "@/large.xyz", "-o", "out/curves.json", "--threads", "1"}}},
      {{"evaluate",
        {"evaluate", "@/network.json", "--truth", "@/network.json", "--json", "out/scores.json",
         "--threads", "1"}}},
      {{"mesh", {"mesh", "@/network.json", "-o", "out/tubes.stl", "--threads", "1"}}},
      {{"resolve",
        {"graph", "@/network.json", "--resolve", "3", "-o", "out/mended.json", "--threads", "1"}}},
      {{"check", {"check", "@/long_scan", "--threads", "1"}, false}}};
  if (TriesEverything()) {
    commands.push_back({{"experiment",
                         {"experiment", "objects", "-o", "out", "--quick", "--objects", "cubeframe",
                          "--profile", "best", "--threads", "1"},
                         false},
                        0,
                        SIGINT,
                        true});
  }
  return commands;
}

// A cubic lattice of wires 4 mm thick, 30 mm apart, whose wires in x pass those in y at `gap`.
std::string NetworkText(int cells, double gap) {
  nlohmann::json nodes = nlohmann::json::array(), edges = nlohmann::json::array();
  const auto add = [&](const std::array<double, 3>& from, const std::array<double, 3>& to) {
    const size_t first = nodes.size();
    nodes.push_back({{"position", from}});
    nodes.push_back({{"position", to}});
    edges.push_back({{"nodes", {first, first + 1}}, {"points", {from, to}}, {"radius", 0.002}});
  };
  const double end = 0.03 * cells;
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) {
      const double a = 0.03 * i, b = 0.03 * j;
      add({0, a, b}, {end, a, b});
      add({a, 0, b + gap}, {a, end, b + gap});
      add({a + gap, b, 0}, {a + gap, b, end});
    }
  }
  return nlohmann::json{{"format", "curvefusion-skeleton"},
                        {"version", 1},
                        {"units", "m"},
                        {"nodes", nodes},
                        {"edges", edges}}
      .dump();
}

// Points around wires 4 mm thick, 20 mm apart, in places that chance decides.
std::string WiresText(int points, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> along(0, 0.3);
  std::uniform_int_distribution<int> wire(0, 9);
  std::normal_distribution<double> noise(0, 0.001);
  std::string text;
  for (int i = 0; i < points; ++i) {
    text += fmt::format("{:.6f} {:.6f} {:.6f}\n", along(random),
                        0.02 * wire(random) + noise(random), 0.02 * wire(random) + noise(random));
  }
  return text;
}

// Inputs that keep commands busy, for seconds where everything is tried.
void WriteInputs(const fs::path& folder, bool earlier) {
  const bool large = TriesEverything();
  std::ofstream(folder / "network.json") << NetworkText(large ? 9 : 2, earlier ? 0.001 : 0.002);
  std::ofstream(folder / "large.xyz") << WiresText(large ? 200'000 : 20'000, earlier ? 1 : 2);
  std::vector<std::string> simulate = {"simulate", "object.json",      "-o",     "long_scan",
                                       "--frames", large ? "60" : "6", "--quiet"};
  if (!large) simulate.insert(simulate.end(), {"--sensor", "ideal", "--frame-rate", "10"});
  const ProgramRun run = RunProgram(folder, simulate);
  if (run.exit_code != 0) throw std::runtime_error("no scan to try with: " + run.output);
}

// Of a live run: the curves so far, which the next ones replace.
void DropSnapshot(Files& files) {
  const auto snapshot = files.find("out/snapshot.json");
  if (snapshot == files.end()) return;
  EXPECT_TRUE(nlohmann::json::accept(snapshot->second)) << "of a live run";
  files.erase(snapshot);
}

class InterruptTest : public testing::TestWithParam<InterruptedCommand> {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TrialFolder;
    WriteInputs(folder_->inputs(), false);
    WriteInputs(folder_->earlier(), true);
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  // What is wrong with how a run ended and with what it left; nothing where it is right.
  std::string FaultOfRun(const ProgramRun& run) const {
    Files found = folder_->Found();
    if (GetParam().keeps_parts) return FaultOfParts(run, found);
    References references = references_;
    if (command().name == "live") {
      for (Files* files : {&found, &references.earlier, &references.result}) DropSnapshot(*files);
    }
    return InterruptFaultOf(run, found, references.earlier, references);
  }

  std::string FaultOfParts(const ProgramRun& run, const Files& found) const {
    if (run.exit_code != 0 && run.exit_code != 130 && run.signal != SIGINT) {
      return fmt::format("exit code {}", run.exit_code);
    }
    for (const auto& [name, bytes] : found) {
      if (!references_.result.contains(name)) return name + " should not be there";
    }
    return "";
  }

  void ExpectAtOnce(const ProgramRun& run) {
    EXPECT_LE(run.cpu_after_signal, kPromised);
    EXPECT_LE(run.after_signal, kLongestWait);
    cpu_.push_back(run.cpu_after_signal);
    seconds_.push_back(run.after_signal);
  }

  // The same command, left alone, gives what it gives where nothing was before.
  void Rerun() {
    const ProgramRun rerun = folder_->Run(command());
    ASSERT_EQ(rerun.exit_code, 0) << rerun.output;
    ++reruns_;
    if (GetParam().keeps_parts) return;
    ASSERT_EQ(Difference(folder_->Found(), references_.result), "none");
  }

  // For the documents.
  void Tell(int interrupts) {
    std::sort(seconds_.begin(), seconds_.end());
    const auto at = [this](double share) {
      return seconds_[static_cast<size_t>(share * static_cast<double>(seconds_.size() - 1))];
    };
    fmt::print(
        "{:<20} {} signals, {} before the end; to the end {:.2f} s (median), {:.2f} s (most), "
        "processor {:.2f} s (most); {} undisturbed runs after them\n",
        command().name, interrupts, seconds_.size(), at(0.5), at(1),
        *std::max_element(cpu_.begin(), cpu_.end()), reruns_);
  }

  const WritingCommand& command() const { return GetParam().command; }

  static TrialFolder* folder_;
  References references_;
  std::vector<double> seconds_, cpu_;  // from each signal to the end
  int reruns_ = 0;
};
TrialFolder* InterruptTest::folder_ = nullptr;

TEST_P(InterruptTest, EndsAtOnceAndLeavesWhatWasThere) {
  references_ = folder_->MakeReferences(command());
  const int interrupts = TriesEverything() ? kManyInterrupts : GetParam().few;
  std::mt19937 random(kSeed);
  double duration = folder_->Duration(command());
  for (int i = 1; i <= interrupts; ++i) {
    const double after = std::uniform_real_distribution<double>(0, duration)(random);
    folder_->Prepare(references_.earlier);
    const ProgramRun run =
        folder_->Run(command(), {.signal_after = after, .signal = GetParam().signal});
    ASSERT_EQ(FaultOfRun(run), "") << fmt::format("interrupted after {} s\n{}", after, run.output);
    if (run.exit_code != 0) ExpectAtOnce(run);
    if (i % kInterruptsToRerun != 0 && i != interrupts) continue;
    if (run.exit_code != 0) Rerun();
    duration = folder_->Duration(command());
  }
  EXPECT_GT(4 * seconds_.size(), static_cast<size_t>(interrupts));
  if (!seconds_.empty()) Tell(interrupts);
}

INSTANTIATE_TEST_SUITE_P(Commands, InterruptTest, testing::ValuesIn(InterruptedCommands()),
                         [](const auto& parameter) { return parameter.param.command.name; });

}  // namespace
}  // namespace curvefusion
