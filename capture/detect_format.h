#pragma once

#include <filesystem>

#include "capture/finding.h"
#include "capture/sequence.h"

namespace curvefusion {

/// Detects the format of a folder or a recording and reads everything but the images. Reports the
/// defects that leave something to go on with, also: no frame left (error), frames dropped
/// (warning). Throws Error(kBadInput) where the format is unknown, a file is missing that the
/// format needs, or there are neither depth images nor poses.
Sequence ReadSequence(const std::filesystem::path& folder, PoseUse poses, DepthUse depth,
                      const FindingHandler& on_finding);

/// The same of depth images, with poses where there are any, and nothing said about defects.
Sequence ReadQuietly(const std::filesystem::path& folder);

}  // namespace curvefusion
