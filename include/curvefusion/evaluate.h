#pragma once

/// A result against the true curves: precision, recall, junctions, diameters; a run as report.json.

#include "experiments/metrics/evaluation_files.h"
#include "experiments/metrics/truth.h"
#include "experiments/run_report.h"
