#include "fusion/segmentation/sheet_stripes.h"

#include <cmath>
#include <optional>

#include "fusion/segmentation/colour_lookup.h"
#include "fusion/segmentation/stripe_field.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Chosen: a stripe goes on straight for so many pixels either way, its normal within 18 degrees.
constexpr int kStraightPx = 6;
constexpr double kParallel = 0.95;
// Chosen, in pixels: nearer crests are one.
constexpr int kNearestPx = 3;
// Derived, of 255: more likely wire than not.
constexpr int kLikely = 128;

bool IsCrest(const StripeField& stripes, const PosteriorImage& image, const Vec2& pixel,
             const Vec2& normal) {
  const int u = static_cast<int>(std::lround(pixel.x()));
  const int v = static_cast<int>(std::lround(pixel.y()));
  if (!image.Contains(u, v)) return false;
  const StripePixel at = stripes.At(u, v);
  return at.part == StripePart::kCrest && std::abs(at.normal.dot(normal)) > kParallel;
}

bool IsStraight(const StripeField& stripes, const PosteriorImage& image, const Vec2& pixel,
                const Vec2& normal) {
  const Vec2 along(-normal.y(), normal.x());
  for (const int step : {-kStraightPx, -kStraightPx / 2, kStraightPx / 2, kStraightPx}) {
    if (!IsCrest(stripes, image, pixel + step * along, normal)) return false;
  }
  return true;
}

// Pixels from the middle of a stripe to that of the nearest one beside it, on either side.
std::optional<int> NextStripe(const StripeField& stripes, const PosteriorImage& image,
                              const Vec2& pixel, const Vec2& normal, int max_px) {
  for (int step = kNearestPx; step <= max_px; ++step) {
    if (IsCrest(stripes, image, pixel + step * normal, normal) ||
        IsCrest(stripes, image, pixel - step * normal, normal)) {
      return step;
    }
  }
  return std::nullopt;
}

// Pixels across a stripe that are likelier wire, as far as the middle of the gap to the next.
int WidthPx(const PosteriorImage& image, const Vec2& pixel, const Vec2& normal, int spacing_px) {
  int width = 0;
  for (int step = -spacing_px / 2; step <= spacing_px / 2; ++step) {
    const Vec2 p = pixel + step * normal;
    const int u = static_cast<int>(std::lround(p.x()));
    const int v = static_cast<int>(std::lround(p.y()));
    width += image.Contains(u, v) && image(u, v) >= kLikely;
  }
  return width;
}

}  // namespace

SheetStripes MeasureStripes(const std::vector<WireCandidates>& frames, const WireColours& colours,
                            const Sequence& sequence, double max_spacing) {
  const ColourLookup lookup(sequence, colours.shift_px);
  const double focal_px = sequence.color_camera.fx;
  double area = 0, striped = 0;
  std::vector<double> spacings, widths;
  for (const WireCandidates& frame : frames) {
    const PosteriorImage posterior = ApplyPosterior(BinColours(frame.color), colours.posterior);
    const StripeField stripes(posterior);
    ForEachColour(PixelsInArrays(frame), frame.depth, lookup, [&](int u, int v, int x, int y) {
      area += 1;
      const StripePixel at = stripes.At(x, y);
      const Vec2 pixel(x, y);
      if (at.part != StripePart::kCrest || !IsStraight(stripes, posterior, pixel, at.normal)) {
        return;
      }
      const double metres_per_px = frame.depth(u, v) / focal_px;
      const auto next = NextStripe(stripes, posterior, pixel, at.normal,
                                   static_cast<int>(max_spacing / metres_per_px));
      if (!next) return;
      striped += *next;
      spacings.push_back(*next * metres_per_px);
      widths.push_back(WidthPx(posterior, pixel, at.normal, *next) * metres_per_px);
    });
  }
  if (spacings.empty()) return {};
  return {striped / area, Median(std::move(spacings)), Median(std::move(widths))};
}

}  // namespace curvefusion
