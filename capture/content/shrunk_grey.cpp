#include "capture/content/shrunk_grey.h"

#include <algorithm>

namespace curvefusion {

int DivisorForWidth(int width, int target) { return std::max(1, (width + target / 2) / target); }

Image<float> ShrunkGrey(const ColorImage& image, int divisor) {
  Image<float> grey(image.width() / divisor, image.height() / divisor, 0);
  const float scale = 1.0f / (3.0f * static_cast<float>(divisor * divisor));
  for (int v = 0; v < grey.height(); ++v) {
    for (int u = 0; u < grey.width(); ++u) {
      int sum = 0;
      for (int y = v * divisor; y < (v + 1) * divisor; ++y) {
        const Rgb* row = image.row(y) + static_cast<ptrdiff_t>(u) * divisor;
        for (int x = 0; x < divisor; ++x) sum += row[x][0] + row[x][1] + row[x][2];
      }
      grey(u, v) = scale * static_cast<float>(sum);
    }
  }
  return grey;
}

}  // namespace curvefusion
