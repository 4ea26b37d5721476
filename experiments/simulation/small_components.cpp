#include "experiments/simulation/small_components.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace curvefusion {
namespace {

using Pixel = std::pair<int, int>;

// The component of the pixel that `component` holds; gives all of it a size other than 0.
void Flood(const Image<float>& image, const ComponentStep& step, Image<int>& sizes,
           std::vector<Pixel>& component) {
  sizes(component.front().first, component.front().second) = 1;
  for (size_t next = 0; next < component.size(); ++next) {
    const auto [from_u, from_v] = component[next];
    const float value = image(from_u, from_v);
    for (const auto& [du, dv] : kPixelsBeside) {
      const int u = from_u + du;
      const int v = from_v + dv;
      if (!image.Contains(u, v) || sizes(u, v) > 0 || !(image(u, v) > 0)) continue;
      if (!step.Joins(image(u, v), value)) continue;
      sizes(u, v) = 1;
      component.emplace_back(u, v);
    }
  }
}

}  // namespace

bool ComponentStep::Joins(float a, float b) const {
  return std::abs(a - b) <= step + slope * std::min(a, b);
}

Image<int> ComponentSizes(const Image<float>& image, const ComponentStep& step) {
  Image<int> sizes(image.width(), image.height(), 0);
  std::vector<Pixel> component;
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      if (sizes(u, v) > 0 || !(image(u, v) > 0)) continue;
      component.assign(1, {u, v});
      Flood(image, step, sizes, component);
      const int size = static_cast<int>(component.size());
      for (const auto& [member_u, member_v] : component) sizes(member_u, member_v) = size;
    }
  }
  return sizes;
}

void DropSmallComponents(Image<float>& image, int min_pixels, const ComponentStep& step) {
  const Image<int> sizes = ComponentSizes(image, step);
  for (size_t i = 0; i < image.size(); ++i) {
    if (sizes.data()[i] < min_pixels) image.data()[i] = 0;
  }
}

}  // namespace curvefusion
