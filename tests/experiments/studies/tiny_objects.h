#pragma once

#include "experiments/studies/study.h"

namespace curvefusion {

/// The study of objects on scans that take seconds: six frames without noise; no tables or figures.
Study TinyObjects();

}  // namespace curvefusion
