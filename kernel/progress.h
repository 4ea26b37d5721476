#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

namespace curvefusion {

/// Long steps call it now and then, always from one thread at a time, with how far they are. It may
/// throw (an Error of kind kInterrupted, say): the step then ends, and nothing is left half-done.
using Progress = std::function<void(std::string_view stage, int64_t done, int64_t total)>;

/// For callers that do not want to know.
inline void NoProgress(std::string_view, int64_t, int64_t) {}

}  // namespace curvefusion
