#pragma once

#include <cstddef>
#include <vector>

namespace curvefusion {

/// At most `count` of the values, evenly spread over their order, the first of them included.
template <class T>
std::vector<T> ThinnedTo(const std::vector<T>& values, std::size_t count) {
  if (values.size() <= count) return values;
  std::vector<T> thinned;
  thinned.reserve(count);
  for (std::size_t i = 0; i < count; ++i) thinned.push_back(values[i * values.size() / count]);
  return thinned;
}

}  // namespace curvefusion
