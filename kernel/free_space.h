#pragma once

#include <cstdint>
#include <filesystem>

namespace curvefusion {

/// Throws Error(kResource), naming both figures, where the disk that will hold `place` has less
/// room than `bytes`; `place` need not be there yet.
void RequireFreeSpace(const std::filesystem::path& place, std::uintmax_t bytes);

}  // namespace curvefusion
