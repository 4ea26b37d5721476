#pragma once

/// @file
/// Settings of the method from TOML files and assignments. Link `curvefusion::experiments`.
///
///     const Config config = ReadConfig({.profile = {},      // as the file says, or the best one
///                                       .file = "my.toml",  // empty: none
///                                       .assignments = {"volume.voxel_size=0.008"}});
///     Reconstruct(sequence, config.pipeline, observer);  // <curvefusion/reconstruct.h>
///     BuildTubes(skeleton, config.tubes);                // <curvefusion/tubes.h>
///
/// `curvefusion config` prints every setting with unit, range and meaning, as such a file;
/// ConfigToml gives the same text. Throws Error(kUsage) for names and values that cannot be.

#include "experiments/config.h"
