#pragma once

#include <filesystem>
#include <vector>

#include "experiments/studies/study.h"

namespace curvefusion {

/// The recordings a request names (`--scans`), then those in sim/ and real/ of its `--data`, by
/// name; truths beside them (NAME.truth) are none.
std::vector<std::filesystem::path> RecordingsOf(const StudyRequest& request);

}  // namespace curvefusion
