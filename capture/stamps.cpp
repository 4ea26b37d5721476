#include "capture/stamps.h"

#include <cmath>
#include <cstddef>
#include <tuple>

namespace curvefusion {

std::vector<std::pair<size_t, size_t>> AssociateStamps(const std::vector<double>& depth,
                                                       const std::vector<double>& color,
                                                       double tolerance) {
  std::vector<std::tuple<double, size_t, size_t>> candidates;  // difference, depth, colour
  size_t first = 0;
  for (size_t d = 0; d < depth.size(); ++d) {
    while (first < color.size() && color[first] < depth[d] - tolerance) ++first;
    for (size_t c = first; c < color.size() && color[c] <= depth[d] + tolerance; ++c) {
      candidates.emplace_back(std::abs(color[c] - depth[d]), d, c);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  constexpr size_t kFree = static_cast<size_t>(-1);
  std::vector<size_t> color_of_depth(depth.size(), kFree);
  std::vector<bool> is_taken(color.size(), false);
  for (const auto& [difference, d, c] : candidates) {
    if (color_of_depth[d] != kFree || is_taken[c]) continue;
    color_of_depth[d] = c;
    is_taken[c] = true;
  }
  std::vector<std::pair<size_t, size_t>> pairs;
  for (size_t d = 0; d < depth.size(); ++d) {
    if (color_of_depth[d] != kFree) pairs.emplace_back(d, color_of_depth[d]);
  }
  return pairs;
}

}  // namespace curvefusion
