#pragma once

#include <string>
#include <vector>

namespace curvefusion {

/// A deviation of the best profile from the paper, and how to do without it.
struct Ablation {
  std::string name;              ///< its row in tables: "carried points"
  std::vector<std::string> off;  ///< assignments for the config that switch it off
  std::string purpose;           ///< what it is for, a sentence
  /// Options ("radius.search_px") and whole sections ("free_ends") that are part of it, besides
  /// those it assigns.
  std::vector<std::string> parts = {};
};

/// All of them, in the order of the method's steps.
std::vector<Ablation> Ablations();

/// An option that is documented as a deviation but cannot be switched off, and why.
struct FixedDeviation {
  std::string option;
  std::string reason;
};
std::vector<FixedDeviation> FixedDeviations();

}  // namespace curvefusion
