#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/studies/result_table.h"

namespace curvefusion {

/// One number from the runs of one seed; none where runs that it needs are not there.
using Measure = std::function<std::optional<double>(const RunGroup&)>;

/// What the paper says of a figure, and so how it is judged.
enum class ClaimKind {
  kWorks,      ///< its method does this: reproduced where ours does, exceeded where it does more
  kFails,      ///< its method cannot: reproduced where ours cannot either, exceeded where it can
  kOthersFail  ///< another method or sensor cannot: reproduced where it cannot here either
};

/// From where on a figure counts as success.
struct Bound {
  double value = 0;
  bool at_most = false;  ///< success is a figure of at most `value`, otherwise at least
  std::optional<double> beyond = {};  ///< of kWorks: from here on the claim is exceeded

  bool Holds(double figure) const { return at_most ? figure <= value : figure >= value; }
  bool IsExceeded(double figure) const {
    return beyond && (at_most ? figure <= *beyond : figure >= *beyond);
  }
};

/// A statement of the paper that scans can confirm or refute.
struct Claim {
  std::string topic;  ///< heading under which the page shows it
  std::string words;  ///< in the paper's words, shortened
  std::string place;  ///< in the paper
  ClaimKind kind = ClaimKind::kWorks;
  std::string study = {};   ///< the study that tests it; empty where none does
  std::string figure = {};  ///< what is measured; of an untested claim: why nothing is
  Measure measure = {};
  Bound bound = {};
  std::string origin = {};  ///< where the bound comes from
  int decimals = 2;
  /// Profiles, methods, or "" for a study without either; a row of results each.
  std::vector<std::string> subjects = {"paper", "best"};
  std::string beside = {};  ///< a method whose runs the measure gets beside those of each subject
  std::string cause = {};   ///< what is known of why it fails, shown where it is not reproduced
};

/// Every quantitative claim and every "works" or "fails" of the paper's section 5 (Results), with
/// those of sections 1, 3 and 4 that it rests on, in the paper's order within a topic.
const std::vector<Claim>& Claims();

// One file each.
std::vector<Claim> ClaimsOfResults();      ///< objects, bundles, spacing, time
std::vector<Claim> ClaimsOfConditions();   ///< sensors, poses, thickness, colour
std::vector<Claim> ClaimsOfComparisons();  ///< other methods, limitations

}  // namespace curvefusion
