#pragma once

/// @file
/// A result against the true curves, as `curvefusion evaluate` compares them: precision and recall,
/// junctions, topology, diameters, surfaces (docs/formats_output.md says what each figure is). And
/// a run as report.json. Link `curvefusion::experiments`.

#include "experiments/metrics/evaluation_files.h"
#include "experiments/metrics/truth.h"
#include "experiments/run_report.h"
