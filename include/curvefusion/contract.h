#pragma once

/// The curves of a cloud (CurvesOfCloud), and their smoothing (SmoothGraph).

#include "graph/contraction/cloud_curves.h"
#include "graph/smoothing.h"
