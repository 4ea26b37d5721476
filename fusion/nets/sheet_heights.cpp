#include "fusion/nets/sheet_heights.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>

#include "fusion/nets/sheet_image.h"
#include "kernel/thinned.h"

namespace curvefusion {

namespace {

// All chosen on training scans chair 5, grid 5 and mixture 3 and 5 (docs/nets.md).
constexpr double kStep = 0.0012;    // metres from pixel to pixel
constexpr int kMoves = 8;           // to both sides
constexpr double kMove = 0.001;     // metres: a third of a pixel from .15 m beside, at .6 m
constexpr size_t kViews = 16;       // enough to tell where they agree
constexpr double kAgreeing = 0.01;  // metres, standard deviation of what agrees together
constexpr float kOff = 0.0015F;     // metres from the sheet, where a height counts half
constexpr int kRounds = 6;          // of heights that count less the farther off they are
constexpr int kOrder = 4;           // of the trend
constexpr int kTerms = (kOrder + 1) * (kOrder + 2) / 2;
using Terms = Eigen::Matrix<double, kTerms, 1>;

// Heights and how clearly each stands out from others that were tried: 0 to 1.
struct TriedHeights {
  Image<float> height, weight;
};

TriedHeights TryHeights(const Sequence& sequence, const std::vector<SheetView>& views,
                        const NetSheet& sheet) {
  const SheetPixels pixels(sheet, kStep);
  const int width = pixels.known.width(), height = pixels.known.height();
  Image<float> best(width, height, std::numeric_limits<float>::infinity()), sum(width, height, 0);
  TriedHeights tried = {Image<float>(width, height, 0), Image<float>(width, height, 0)};
  MaskImage told = pixels.known;
  for (int move = -kMoves; move <= kMoves; ++move) {
    const SheetColours colours =
        ColoursOf(LookAt(sequence, views, pixels, kMove * move * sheet.axes.col(2)), pixels.known);
    for (size_t i = 0; i < told.size(); ++i) told.data()[i] &= colours.change.data()[i] >= 0;
    const Image<float> change = MeanAround(colours.change, told, kAgreeing / kStep);
    for (size_t i = 0; i < change.size(); ++i) {
      sum.data()[i] += change.data()[i];
      if (change.data()[i] >= best.data()[i]) continue;
      best.data()[i] = change.data()[i];
      tried.height.data()[i] = static_cast<float>(kMove * move);
    }
  }
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      if (!told(u, v) || !(sum(u, v) > 0)) continue;
      tried.weight(u, v) = 1 - best(u, v) * (2 * kMoves + 1) / sum(u, v);
      tried.height(u, v) += static_cast<float>(sheet.HeightAt(kStep * u, kStep * v));
    }
  }
  return tried;
}

Terms TermsAt(const Image<float>& image, int u, int v) {
  const double x = 2.0 * u / image.width() - 1, y = 2.0 * v / image.height() - 1;
  Terms terms;
  int term = 0;
  double power_x = 1;
  for (int i = 0; i <= kOrder; ++i, power_x *= x) {
    double power_y = 1;
    for (int j = 0; i + j <= kOrder; ++j, power_y *= y) terms[term++] = power_x * power_y;
  }
  return terms;
}

// The polynomial that fits best.
Image<float> TrendOf(const Image<float>& image, const Image<float>& weight) {
  constexpr double kAlmostNothing = 1e-6;  // holds terms that nothing tells; chosen
  Eigen::Matrix<double, kTerms, kTerms> squares =
      kAlmostNothing * Eigen::Matrix<double, kTerms, kTerms>::Identity();
  Terms products = Terms::Zero();
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      if (!(weight(u, v) > 0)) continue;
      const Terms terms = TermsAt(image, u, v);
      squares += weight(u, v) * terms * terms.transpose();
      products += weight(u, v) * image(u, v) * terms;
    }
  }
  const Terms factors = squares.ldlt().solve(products);
  Image<float> trend(image.width(), image.height());
  for (int v = 0; v < image.height(); ++v)
    for (int u = 0; u < image.width(); ++u)
      trend(u, v) = static_cast<float>(factors.dot(TermsAt(image, u, v)));
  return trend;
}

// The trend of what is not far off it.
Image<float> Smoothed(const TriedHeights& tried) {
  Image<float> weight = tried.weight;
  for (int round = 1;; ++round) {
    Image<float> trend = TrendOf(tried.height, weight);
    if (round == kRounds) return trend;
    for (size_t i = 0; i < weight.size(); ++i) {
      const float off = (tried.height.data()[i] - trend.data()[i]) / kOff;
      weight.data()[i] = tried.weight.data()[i] / (1 + off * off);
    }
  }
}

}  // namespace

void MoveToWhereImagesAgree(const Sequence& sequence, const std::vector<SheetView>& views,
                            NetSheet& sheet) {
  const Image<float> smooth = Smoothed(TryHeights(sequence, ThinnedTo(views, kViews), sheet));
  for (int v = 0; v < sheet.heights.height(); ++v) {
    for (int u = 0; u < sheet.heights.width(); ++u) {
      const int x = static_cast<int>(u * NetSheet::kStep / kStep);
      const int y = static_cast<int>(v * NetSheet::kStep / kStep);
      sheet.heights(u, v) =
          smooth(std::min(x, smooth.width() - 1), std::min(y, smooth.height() - 1));
    }
  }
}

}  // namespace curvefusion
