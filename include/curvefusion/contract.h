#pragma once

/// @file
/// The curves of a point cloud of thin structures, in metres (CurvesOfCloud): by density ridges, or
/// by the paper's L1 medial axis (4.2). And the paper's smoothing of curves (SmoothGraph: 4.3,
/// Eq. 1). Link `curvefusion::graph`.
///
///     const SkeletonGraph curves = CurvesOfCloud(ReadCloud("cloud.ply"), {.radius = 0.002});

#include "graph/contraction/cloud_curves.h"
#include "graph/smoothing.h"
