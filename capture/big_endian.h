#pragma once

#include <cstdint>
#include <string_view>

namespace curvefusion {

/// The number that up to four bytes are, the first the most significant.
inline uint32_t BigEndian(std::string_view bytes) {
  uint32_t value = 0;
  for (const char byte : bytes) value = value * 256 + static_cast<unsigned char>(byte);
  return value;
}

}  // namespace curvefusion
