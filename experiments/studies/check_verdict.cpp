#include "experiments/studies/check_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

namespace curvefusion {

namespace {

using nlohmann::json;

// What `check` says of how a recording was made, whatever is right or wrong about its files.
const std::set<std::string>& Remarks() {
  static const std::set<std::string> remarks = {
      "no-poses",    "too-few-frames", "static-camera",    "path-too-short",
      "too-far",     "depth-sparse",   "too-dark",         "over-exposed",
      "motion-blur", "no-colour",      "distortion-undone"};
  return remarks;
}

constexpr double kScaleTolerance = 1.07;  // what the check takes calibration to be off by
constexpr double kMinStretchOverlap = 0.5;

std::string CauseOf(const json& finding) {
  return finding.at("cause").is_null() ? "no cause" : finding.at("cause").get<std::string>();
}

std::string Description(const json& finding) {
  std::string text = CauseOf(finding);
  if (!finding.at("amount").is_null()) {
    text += fmt::format(" {:.4g} {}", finding["amount"]["value"].get<double>(),
                        finding["amount"]["unit"].get<std::string>());
  }
  for (const json& stretch : finding.at("frames")) {
    text += fmt::format(" {}..{}", stretch["first"].get<std::string>(),
                        stretch["last"].get<std::string>());
  }
  return text;
}

bool IsRightAmount(const json& amount, const MistakeAmount& expected, double frame_period) {
  if (amount.is_null() || amount.at("unit") != expected.unit) return false;
  const double value = amount.at("value");
  if (expected.unit == "frames") return value == expected.value;
  if (expected.unit == "s") return std::abs(value - expected.value) <= 0.5 * frame_period;
  const double ratio = value / expected.value;
  return ratio < kScaleTolerance && 1 / ratio < kScaleTolerance;
}

// The numbers of the frames of some stretches.
std::set<int> Numbers(const std::vector<FrameStretch>& stretches,
                      const std::vector<std::string>& names) {
  const auto number = [&](const std::string& name) {
    return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  std::set<int> numbers;
  for (const FrameStretch& stretch : stretches) {
    for (int i = number(stretch.first); i <= number(stretch.last); ++i) numbers.insert(i);
  }
  return numbers;
}

bool AreRightFrames(const json& frames, const CheckExpectation& expected) {
  std::vector<FrameStretch> stretches;
  for (const json& stretch : frames) stretches.push_back({stretch["first"], stretch["last"]});
  const std::set<int> found = Numbers(stretches, expected.frame_names);
  const std::set<int> right = Numbers(expected.mistake.frames, expected.frame_names);
  if (expected.mistake.cause == "pose-jump") return found == right;
  const auto common =
      std::count_if(found.begin(), found.end(), [&](int frame) { return right.contains(frame); });
  const auto all = static_cast<double>(found.size() + right.size()) - static_cast<double>(common);
  return static_cast<double>(common) >= kMinStretchOverlap * all;
}

bool IsRight(const json& finding, const CheckExpectation& expected) {
  if (CauseOf(finding) != expected.mistake.cause) return false;
  if (expected.mistake.amount &&
      !IsRightAmount(finding.at("amount"), *expected.mistake.amount, expected.frame_period)) {
    return false;
  }
  return expected.mistake.frames.empty() || AreRightFrames(finding.at("frames"), expected);
}

void Append(const std::string& text, std::string& list) {
  list += (list.empty() ? "" : "; ") + text;
}

}  // namespace

CheckVerdict JudgeCheck(const json& check, const CheckExpectation& expected) {
  const bool is_good = expected.mistake.cause.empty();
  CheckVerdict verdict;
  int right = 0;
  int wrong = 0;
  for (const json& finding : check.at("findings")) {
    const std::string cause = CauseOf(finding);
    if (Remarks().contains(cause)) {
      Append(cause, verdict.remarks);
      continue;
    }
    Append(Description(finding), verdict.named);
    const bool is_excused = cause == "colour-misregistered" && expected.may_misplace_colour;
    // Frames without a pose and the like come with many a mistake.
    const bool is_consequence = cause == "no cause" && !is_good;
    if (IsRight(finding, expected)) {
      ++right;
    } else if (!is_excused && !is_consequence) {
      ++wrong;
    }
  }
  if (verdict.named.empty()) verdict.named = "nothing";
  verdict.is_right = wrong == 0 && (is_good ? check.at("usable").get<bool>() : right > 0);
  return verdict;
}

}  // namespace curvefusion
