#include "kernel/morton_order.h"

#include <array>
#include <bit>

namespace curvefusion {

namespace {

// A whole number that is ordered as coordinates are.
uint64_t OrderedBits(double coordinate) {
  const auto bits = std::bit_cast<uint64_t>(coordinate + 0.0);  // makes the two zeros one
  constexpr uint64_t kSign = uint64_t{1} << 63;
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

// The first 21 bits, two zeros before each.
uint64_t Spread(uint64_t bits) {
  bits >>= 43;
  bits = (bits | bits << 32) & 0x001f00000000ffff;
  bits = (bits | bits << 16) & 0x001f0000ff0000ff;
  bits = (bits | bits << 8) & 0x100f00f00f00f00f;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
  return (bits | bits << 2) & 0x1249249249249249;
}

}  // namespace

uint64_t MortonCode(const Vec3& p) {
  return Spread(OrderedBits(p.x())) << 2 | Spread(OrderedBits(p.y())) << 1 |
         Spread(OrderedBits(p.z()));
}

bool ComesBefore(const Vec3& a, const Vec3& b) {
  uint64_t most = 0;  // what differs in the coordinate that differs in the highest bit
  bool is_less = false;
  for (int i = 0; i < 3; ++i) {
    const uint64_t in_a = OrderedBits(a[i]);
    const uint64_t in_b = OrderedBits(b[i]);
    const uint64_t different = in_a ^ in_b;
    if (std::bit_width(different) <= std::bit_width(most)) continue;
    most = different;
    is_less = in_a < in_b;
  }
  return is_less;
}

}  // namespace curvefusion
