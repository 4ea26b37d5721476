#pragma once

/// Is a scan as it says? Geometry, colour against depth, suitability: CheckSequence, its findings as
/// JSON, and the colour camera that was fitted.

#include "capture/check.h"
#include "capture/check_json.h"
#include "capture/content/colour_findings.h"
