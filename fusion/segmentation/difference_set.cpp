#include "fusion/segmentation/difference_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "capture/depth_noise.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr int64_t kRowsPerChunk = 16;  // chosen: a task of some 10,000 pixels
// Metres. Chosen: farther behind a removed thin part a pixel is background seen past it.
constexpr double kBehindRemoved = 0.02;

// Smallest depth within +-radius of every entry of a line, missing entries (0) counting as
// infinitely far. A plain window scan: the radius is a few pixels.
void MinimumAlong(const float* line, int n, int stride, int radius, float* result) {
  for (int i = 0; i < n; ++i) {
    float least = kNothing;
    for (int j = std::max(0, i - radius); j <= std::min(n - 1, i + radius); ++j) {
      least = std::min(least, line[static_cast<std::ptrdiff_t>(j) * stride]);
    }
    result[static_cast<std::ptrdiff_t>(i) * stride] = least;
  }
}

// The nearest kept surface within a square of +-radius pixels; infinity where there is none.
DepthImage NearestWithin(const DepthImage& kept, int radius) {
  DepthImage rows(kept.width(), kept.height());
  DepthImage squares(kept.width(), kept.height());
  ParallelFor(0, kept.height(), kRowsPerChunk, [&](int64_t v) {
    std::vector<float> line(kept.row(static_cast<int>(v)),
                            kept.row(static_cast<int>(v)) + kept.width());
    for (float& depth : line) depth = depth > 0 ? depth : kNothing;
    MinimumAlong(line.data(), kept.width(), 1, radius, rows.row(static_cast<int>(v)));
  });
  ParallelFor(0, kept.width(), kRowsPerChunk, [&](int64_t u) {
    MinimumAlong(rows.data() + u, kept.height(), kept.width(), radius, squares.data() + u);
  });
  return squares;
}

// Whether a raw depth belongs to the set, given what was rendered at its pixel and the nearest kept
// surface around it.
bool IsThin(float depth, float rendered, float kept, float nearest_kept,
            const DifferenceSetOptions& options) {
  if (depth < options.min_depth || depth > options.max_depth) return false;
  if (depth > nearest_kept - options.front_distance) return false;  // most pixels: before all noise
  if (rendered <= 0 && !options.accept_where_nothing_rendered) return false;
  const double noise = kClearDeviations * DepthNoise(depth);
  if (depth > nearest_kept - noise) return false;
  const bool removed = rendered > 0 && kept <= 0;
  return !removed || depth < rendered + std::max(kBehindRemoved, noise);
}

// Keeps pixels with enough set pixels of similar depth among the 24 around them.
MaskImage WithNeighbours(const MaskImage& mask, const DepthImage& depth,
                         const DifferenceSetOptions& options) {
  MaskImage supported(mask.width(), mask.height(), 0);
  ParallelFor(0, mask.height(), kRowsPerChunk, [&](int64_t row) {
    const int v = static_cast<int>(row);
    for (int u = 0; u < mask.width(); ++u) {
      if (!mask(u, v)) continue;
      const float z = depth(u, v);
      const double tolerance = std::max(0.005, kClearDeviations * DepthNoise(z));
      int neighbours = -1;  // not itself
      for (int y = std::max(0, v - 2); y <= std::min(mask.height() - 1, v + 2); ++y) {
        for (int x = std::max(0, u - 2); x <= std::min(mask.width() - 1, u + 2); ++x) {
          neighbours += mask(x, y) && std::abs(depth(x, y) - z) <= tolerance;
        }
      }
      supported(u, v) = neighbours >= options.min_neighbours;
    }
  });
  return supported;
}

}  // namespace

void VisitOptions(DifferenceSetOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"front_distance", "m", 0, 0.2,
                 "Deviation: a pixel must lie at least so far in front of kept surfaces; surfaces "
                 "are noisier than their mean model."},
                options.front_distance);
  visitor.Visit({"silhouette_margin_px", "px", 0, 30,
                 "Deviation: kept surfaces count so many pixels beyond their silhouettes; block "
                 "matching fattens them."},
                options.silhouette_margin_px);
  visitor.Visit(
      {"accept_where_nothing_rendered", "", 0, 1,
       "Whether pixels with no rendering behind them belong to the set. CurveFusion 4.1."},
      options.accept_where_nothing_rendered);
  visitor.Visit({"min_neighbours", "px", 0, 24,
                 "Deviation: so many of the 24 pixels around must be in the set at the same depth; "
                 "lone pixels are noise."},
                options.min_neighbours);
  visitor.Visit({"min_depth", "m", 0, 10, "Nearer depth is ignored: below the sensor's range."},
                options.min_depth);
  visitor.Visit({"max_depth", "m", 0.1, 20,
                 "Farther depth is ignored: thin structures are not measured there."},
                options.max_depth);
}

MaskImage ImageDifferenceSet(const DepthImage& depth, const DepthImage& rendering,
                             const DepthImage& kept, const DifferenceSetOptions& options) {
  const int factor = Divisor(depth, rendering);
  const int margin = static_cast<int>(std::ceil(options.silhouette_margin_px / factor));
  const DepthImage nearest_kept = NearestWithin(kept, margin);
  MaskImage mask(depth.width(), depth.height(), 0);
  ParallelFor(0, depth.height(), kRowsPerChunk, [&](int64_t row) {
    const int v = static_cast<int>(row);
    const int small_v = std::min(v / factor, rendering.height() - 1);
    for (int u = 0; u < depth.width(); ++u) {
      const int small_u = std::min(u / factor, rendering.width() - 1);
      mask(u, v) = IsThin(depth(u, v), rendering(small_u, small_v), kept(small_u, small_v),
                          nearest_kept(small_u, small_v), options);
    }
  });
  return options.min_neighbours > 0 ? WithNeighbours(mask, depth, options) : mask;
}

}  // namespace curvefusion
