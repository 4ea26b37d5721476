#pragma once

/// @file
/// Point clouds from and to files: PLY, PCD, XYZ. ReadCloud gives points in the unit of the file;
/// everything else here takes metres. Link `curvefusion::kernel`.
///
///     const ObservedPoints points = ReadCloud("cloud.ply");  // points.positions[i]

#include "kernel/cloud_io.h"
