#include "experiments/simulation/small_components.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace curvefusion {
namespace {

using Pixel = std::pair<int, int>;

// The component of the pixel that `component` holds; marks all of it as seen.
void Flood(const Image<float>& image, double max_step, MaskImage& seen,
           std::vector<Pixel>& component) {
  constexpr std::array<Pixel, 4> kNeighbors = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  seen(component.front().first, component.front().second) = 1;
  for (size_t next = 0; next < component.size(); ++next) {
    const auto [from_u, from_v] = component[next];
    const float value = image(from_u, from_v);
    for (const auto& [du, dv] : kNeighbors) {
      const int u = from_u + du;
      const int v = from_v + dv;
      if (!image.Contains(u, v) || seen(u, v) || !(image(u, v) > 0)) continue;
      if (std::abs(image(u, v) - value) > max_step) continue;
      seen(u, v) = 1;
      component.emplace_back(u, v);
    }
  }
}

}  // namespace

void DropSmallComponents(Image<float>& image, int min_pixels, double max_step) {
  MaskImage seen(image.width(), image.height(), 0);
  std::vector<Pixel> component;
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      if (seen(u, v) || !(image(u, v) > 0)) continue;
      component.assign(1, {u, v});
      Flood(image, max_step, seen, component);
      if (static_cast<int>(component.size()) >= min_pixels) continue;
      for (const auto& [small_u, small_v] : component) image(small_u, small_v) = 0;
    }
  }
}

}  // namespace curvefusion
