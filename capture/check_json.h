#pragma once

#include <string>

#include "capture/check.h"

namespace curvefusion {

/// What `check --json` prints: one JSON object with all figures of the report and its findings,
/// errors first. Metres and seconds; null means unknown.
std::string CheckJson(const CheckReport& report);

}  // namespace curvefusion
