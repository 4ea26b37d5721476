#pragma once

#include <functional>
#include <string>

namespace curvefusion {

/// How bad a defect of a sequence is.
enum class Severity {
  kWarning,  ///< the scan can be used, but the user should know
  kError,    ///< a reconstruction would fail or be wrong
};

/// One thing that is wrong with a sequence: names file, frame, value and remedy.
struct CheckFinding {
  Severity severity = Severity::kError;
  std::string message;
  std::string cause = {};  ///< what programs know it by, e.g. "poses-inverted"; empty where it has
                           ///< no name
};

/// What the readers call for each defect. A handler that throws ends the reading (OpenSequence does
/// so at the first error); one that returns lets the reader leave out the frame and go on
/// (CheckSequence collects).
using FindingHandler = std::function<void(const CheckFinding&)>;

}  // namespace curvefusion
