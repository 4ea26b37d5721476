#include "capture/content/edge_distance.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "capture/content/shrunk_grey.h"

namespace curvefusion {

namespace {

constexpr double kReferenceWidth = 640;
constexpr int kWorkingWidth = 320;  // chosen: half a pixel of it is 1 px, a third of what is asked
constexpr float kMinGradient = 3;   // grey levels a pixel; measured: noise of 3/255 stays below
constexpr double kEdgeQuantile =
    0.8;  // of the gradients; chosen: textured images have edges all over
// Chamfer distances 3 and 4 for steps along and across (Borgefors 1986), so 3 is one pixel.
constexpr int kStep = 3;
constexpr int kDiagonal = 4;

struct Gradients {
  Image<float> x, y, magnitude;
};

// Sobel's operator, which smoothes across; 0 along the border.
Gradients SobelGradients(const Image<float>& grey) {
  const int width = grey.width(), height = grey.height();
  Gradients g{Image<float>(width, height, 0), Image<float>(width, height, 0),
              Image<float>(width, height, 0)};
  for (int v = 1; v + 1 < height; ++v) {
    const float* above = grey.row(v - 1);
    const float* here = grey.row(v);
    const float* below = grey.row(v + 1);
    for (int u = 1; u + 1 < width; ++u) {
      const float x = (above[u + 1] - above[u - 1] + 2 * (here[u + 1] - here[u - 1]) +
                       below[u + 1] - below[u - 1]) /
                      8;
      const float y =
          (below[u - 1] - above[u - 1] + 2 * (below[u] - above[u]) + below[u + 1] - above[u + 1]) /
          8;
      g.x(u, v) = x;
      g.y(u, v) = y;
      g.magnitude(u, v) = std::sqrt(x * x + y * y);
    }
  }
  return g;
}

float GradientLimit(const Image<float>& magnitude) {
  if (magnitude.empty()) return kMinGradient;
  std::vector<float> values(magnitude.data(), magnitude.data() + magnitude.size());
  const auto place = values.begin() +
                     static_cast<ptrdiff_t>(kEdgeQuantile * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return std::max(kMinGradient, *place);
}

void Lower(uint8_t& distance, int other) {
  if (other < distance) distance = static_cast<uint8_t>(other);
}

// A row whose distances may lead over the row beside it, which is done; none beside the first.
void LowerByRow(const uint8_t* beside, int width, uint8_t* row) {
  if (beside == nullptr) return;
  for (int u = 0; u < width; ++u) Lower(row[u], beside[u] + kStep);
  for (int u = 1; u < width; ++u) Lower(row[u], beside[u - 1] + kDiagonal);
  for (int u = 0; u + 1 < width; ++u) Lower(row[u], beside[u + 1] + kDiagonal);
}

// Replaces 0 (edge) and 255 (none) by the chamfer distance, cut off at 255.
void ToDistances(Image<uint8_t>& image) {
  const int width = image.width(), height = image.height();
  for (int v = 0; v < height; ++v) {
    uint8_t* row = image.row(v);
    LowerByRow(v == 0 ? nullptr : image.row(v - 1), width, row);
    for (int u = 1; u < width; ++u) Lower(row[u], row[u - 1] + kStep);
  }
  for (int v = height - 1; v >= 0; --v) {
    uint8_t* row = image.row(v);
    LowerByRow(v + 1 == height ? nullptr : image.row(v + 1), width, row);
    for (int u = width - 2; u >= 0; --u) Lower(row[u], row[u + 1] + kStep);
  }
}

}  // namespace

EdgeDistance::EdgeDistance(const ColorImage& image) {
  const int divisor = DivisorForWidth(image.width(), kWorkingWidth);
  const Gradients g = SobelGradients(ShrunkGrey(image, divisor));
  divisor_ = divisor;
  unit_ = divisor * kReferenceWidth / image.width() / kStep;
  const int width = g.magnitude.width(), height = g.magnitude.height();
  for (auto& direction : distances_) direction = Image<uint8_t>(width, height, 255);
  const float limit = GradientLimit(g.magnitude);
  size_t edges = 0;
  for (int v = 1; v + 1 < height; ++v) {
    for (int u = 1; u + 1 < width; ++u) {
      const float here = g.magnitude(u, v);
      if (here <= limit) continue;
      const bool is_steep = std::abs(g.x(u, v)) > std::abs(g.y(u, v));
      const int du = is_steep ? 1 : 0, dv = is_steep ? 0 : 1;
      if (here < g.magnitude(u - du, v - dv) || here <= g.magnitude(u + du, v + dv)) continue;
      ++edges;
      // An edge belongs to its direction and the next one: normals of depth are rough.
      const double angle = std::atan2(g.y(u, v), g.x(u, v)) / std::numbers::pi * kDirections;
      const int lower = static_cast<int>(std::floor(angle));
      const double share = angle - lower;
      for (int k = 0; k < 2; ++k) {
        if ((k == 0 ? share : 1 - share) > 0.75) continue;
        distances_[static_cast<size_t>((lower + k + 2 * kDirections) % kDirections)](u, v) = 0;
      }
    }
  }
  for (auto& direction : distances_) ToDistances(direction);
  edge_share_ = g.magnitude.empty()
                    ? 0
                    : static_cast<double>(edges) / static_cast<double>(g.magnitude.size());
}

int EdgeDistance::DirectionOf(double angle) {
  const int direction = static_cast<int>(std::lround(angle / std::numbers::pi * kDirections));
  return (direction % kDirections + kDirections) % kDirections;
}

bool EdgeDistance::Contains(const Vec2& pixel) const {
  const Image<uint8_t>& image = distances_[0];
  const double u = (pixel.x() + 0.5) / divisor_ - 0.5;
  const double v = (pixel.y() + 0.5) / divisor_ - 0.5;
  return u >= 0 && v >= 0 && u < image.width() - 1 && v < image.height() - 1;
}

double EdgeDistance::Nearest(const Vec2& pixel, int direction) const {
  const Image<uint8_t>& image = distances_[static_cast<size_t>(direction)];
  const int u = static_cast<int>((pixel.x() + 0.5) / divisor_);
  const int v = static_cast<int>((pixel.y() + 0.5) / divisor_);
  return std::min(kFarthest, unit_ * image(u, v));
}

EdgeDistance::Sample EdgeDistance::Interpolated(const Vec2& pixel, int direction) const {
  const Image<uint8_t>& image = distances_[static_cast<size_t>(direction)];
  const double u = (pixel.x() + 0.5) / divisor_ - 0.5;
  const double v = (pixel.y() + 0.5) / divisor_ - 0.5;
  const int iu = static_cast<int>(u), iv = static_cast<int>(v);
  const double a = u - iu, b = v - iv;
  const auto at = [&](int x, int y) { return std::min(kFarthest, unit_ * image(x, y)); };
  const double d00 = at(iu, iv), d10 = at(iu + 1, iv);
  const double d01 = at(iu, iv + 1), d11 = at(iu + 1, iv + 1);
  const double upper = d00 + a * (d10 - d00), lower = d01 + a * (d11 - d01);
  return {upper + b * (lower - upper), ((1 - b) * (d10 - d00) + b * (d11 - d01)) / divisor_,
          (lower - upper) / divisor_};
}

}  // namespace curvefusion
