#include "apps/progress_printer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <iostream>
#include <optional>
#include <utility>

namespace curvefusion {

namespace {

constexpr double kTerminalInterval = 0.1;  // seconds between two updates of the line
constexpr double kLinesInterval = 10;      // seconds between two lines of one stage
constexpr double kEarliestEstimate = 1;    // seconds before a time left is worth showing

std::string Duration(double seconds) {
  const auto whole = static_cast<int64_t>(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  return fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

}  // namespace

ProgressPrinter::ProgressPrinter(std::ostream& stream, Style style, Clock clock)
    : stream_(stream),
      style_(style),
      clock_(std::move(clock)),
      run_start_(clock_()),
      last_report_(run_start_) {}

void ProgressPrinter::Plan(const std::vector<PlannedStage>& stages) {
  is_planned_ = true;
  run_.Plan(stages);
}

void ProgressPrinter::Report(const std::string& stage, int64_t done, int64_t total) {
  if (style_ == Style::kQuiet) return;
  const double now = clock_();
  if (stage != stage_ || done < done_) BeginStage(stage, now);
  run_.Report(stage, done, total, now);
  done_ = done;
  total_ = total;
  last_report_ = now;
  const double interval = style_ == Style::kTerminal ? kTerminalInterval : kLinesInterval;
  if (now - last_print_ < interval) return;
  last_print_ = now;
  stream_ << (style_ == Style::kTerminal ? "\r\033[K" + Line() : Line() + "\n") << std::flush;
}

void ProgressPrinter::BeginStage(const std::string& stage, double start) {
  Finish();
  stage_ = stage;
  stage_start_ = start;
  last_print_ = style_ == Style::kTerminal ? start - 2 * kTerminalInterval : start;
}

void ProgressPrinter::Finish() {
  if (stage_.empty()) return;
  const std::string line = fmt::format("{:<34} {:>6.1f} s", stage_, clock_() - stage_start_);
  stream_ << (style_ == Style::kTerminal ? "\r\033[K" : "") << line << std::endl;
  stage_.clear();
  done_ = 0;
}

// "segmentation  65 of 150            43 % of the run, 25 s left"
std::string ProgressPrinter::RunLine() const {
  const std::string steps = total_ > 1 ? fmt::format("{} of {}", done_, total_) : "";
  const std::string line = fmt::format("{:<34} {}", stage_, steps);
  const std::optional<double> left = run_.SecondsLeft(last_report_);
  const double elapsed = last_report_ - run_start_;
  if (!left || elapsed + *left <= 0) return line;
  const double share = elapsed / (elapsed + *left);
  return fmt::format("{:<52} {:>2.0f} % of the run, {} left", line, std::floor(100 * share),
                     Duration(*left));
}

std::string ProgressPrinter::Line() const {
  if (is_planned_) return RunLine();
  return fmt::format("{:<34} {:>3} %  {} of {}{}", stage_, total_ > 0 ? 100 * done_ / total_ : 0,
                     done_, total_, TimeLeft());
}

std::string ProgressPrinter::TimeLeft() const {
  const double elapsed = last_report_ - stage_start_;
  if (done_ <= 0 || done_ >= total_ || elapsed < kEarliestEstimate) return "";
  const double left = elapsed * static_cast<double>(total_ - done_) / static_cast<double>(done_);
  return fmt::format(", {} left", Duration(left));
}

ProgressPrinter MakeProgressPrinter(bool quiet) {
  const auto seconds = [start = std::chrono::steady_clock::now()] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const auto style = quiet                        ? ProgressPrinter::Style::kQuiet
                     : isatty(STDERR_FILENO) != 0 ? ProgressPrinter::Style::kTerminal
                                                  : ProgressPrinter::Style::kLines;
  return {std::cerr, style, seconds};
}

}  // namespace curvefusion
