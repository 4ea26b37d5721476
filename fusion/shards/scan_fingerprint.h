#pragma once

#include <optional>
#include <string>

#include "capture/sequence.h"

namespace curvefusion {

/// What tells a scan from others, a line "name = value" each: format, cameras, and of every frame
/// its pose and the names, places and sizes of its images; files are named from the sequence's
/// folder on, so that the scan may lie elsewhere on another machine. Numbers are written with as
/// many digits as it takes to read the same double back. Pixels are not looked at. Linear in
/// frames, 1 kB each.
std::string ScanFingerprint(const Sequence& sequence);

/// A line that is not the same in two texts of lines "name = value".
struct ChangedLine {
  std::string name;
  std::string before;
  std::string now;  ///< "nothing" where there is no such line
};

/// The first such line; none where the texts are the same.
std::optional<ChangedLine> FirstChange(const std::string& before, const std::string& now);

}  // namespace curvefusion
