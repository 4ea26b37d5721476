#pragma once

/// @file
/// Is a scan as it says? Link `curvefusion::capture`.
///
///     const CheckReport report = CheckSequence("scan", NoProgress);
///     for (const CheckFinding& finding : report.findings) std::puts(finding.message.c_str());
///
/// CheckSequence reads every image and looks at poses, depth unit and clocks, at colour against
/// depth, and at what makes a scan unsuitable (docs/check.md); what is wrong with the data is a
/// finding and throws nothing. CheckJson writes its report as JSON. UseFittedColourCamera gives a
/// sequence the colour camera that fits its images where colour lies beside depth.

#include "capture/check.h"
#include "capture/check_json.h"
#include "capture/content/colour_findings.h"
