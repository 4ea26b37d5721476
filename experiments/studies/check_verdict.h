#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "capture/content/geometry_check.h"

namespace curvefusion {

/// What a scan has, to be held against what `check` says of it.
struct CheckExpectation {
  Mistake mistake;                   ///< cause, frames, amount; no cause: a good scan
  bool may_misplace_colour = false;  ///< colour is truly misregistered, too
  std::vector<std::string> frame_names;
  double frame_period = 0;  ///< seconds, of scans with a clock
};

struct CheckVerdict {
  std::string named;    ///< every complaint, "poses-late 2 frames"; "nothing"
  std::string remarks;  ///< on the recording: "too-far", ...
  bool is_right = false;
};

/// Judges the JSON object of `check --json`. Remarks on how a recording was made (too far away, too
/// few frames, dark, blurred, ...) are no complaints. A wrong version is named rightly where there
/// is no complaint but of its cause, and with the right amount (frames exactly, clocks to half a
/// frame, scales to 7 %) or frames (a jump's exactly; half of a stretch's and hardly others). On a
/// good scan every complaint is wrong, and so is an error.
CheckVerdict JudgeCheck(const nlohmann::json& check, const CheckExpectation& expected);

}  // namespace curvefusion
