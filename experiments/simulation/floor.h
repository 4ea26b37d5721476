#pragma once

#include <cstdint>

namespace curvefusion {

/// std::floor of what fits into 32 bits, without its call.
inline int32_t Floor(double value) {
  const auto whole = static_cast<int32_t>(value);
  return value < whole ? whole - 1 : whole;
}

}  // namespace curvefusion
