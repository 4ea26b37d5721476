#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "experiments/config.h"
#include "experiments/sweeps/unit_samples.h"

namespace curvefusion {

/// One choice of settings: "section.key=value" for each; empty = the profile as it is.
using SettingPoint = std::vector<std::string>;

/// All combinations of values: for each setting its name and the values as texts.
std::vector<SettingPoint> GridPoints(
    const std::vector<std::pair<std::string, std::vector<std::string>>>& values);

/// Where a setting is sampled.
struct SettingRange {
  std::string name;  ///< "section.key"
  double from = 0;
  double to = 1;
  bool log = false;  ///< evenly in ratios
};

struct SampleOptions {
  Sampling sampling = Sampling::kSobol;
  int points = 0;
  uint64_t seed = 1;
};

/// Samples of the box that the ranges span, numbers rounded to four digits, those of whole-number
/// settings to whole ones. Throws Error(kUsage) for a range that is none, a logarithmic one that
/// does not begin above 0, and settings that are true or false.
std::vector<SettingPoint> SampledPoints(const std::vector<SettingRange>& ranges,
                                        const SampleOptions& options, Profile profile);

}  // namespace curvefusion
