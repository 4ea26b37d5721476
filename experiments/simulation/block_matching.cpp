#include "experiments/simulation/block_matching.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "experiments/simulation/small_components.h"

// The hot loops once for processors with AVX2 and once for all: integer sums and single float
// operations, so both give the same bits. Sanitizers cannot run the code that chooses.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CURVEFUSION_TARGET_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define CURVEFUSION_TARGET_CLONES
#endif

namespace curvefusion {
namespace {

constexpr int kHalf = 4;
constexpr int kBlock = 2 * kHalf + 1;
constexpr int kBlockPixels = kBlock * kBlock;
constexpr int kPatchStride = 16;  // a block's row, filled up with zeros
constexpr int kDisparities = BlockMatcher::kDisparities;
constexpr int kMargin = 128;          // columns left of the image that disparities reach
constexpr int kReferencePeak = 255;   // 81 * 81 * 1023 * 255 still fits into 31 bits
constexpr float kKeyScale = 1 << 22;  // correlations as integers
constexpr int kKeyShift = 7;          // with the disparity in the lowest bits
static_assert(kDisparities <= 1 << kKeyShift);
static_assert(BlockMatcher::kMinDisparity + kDisparities + kHalf < kMargin);

// columns[d] += enter * reference_enter[d] - leave * reference_leave[d]
CURVEFUSION_TARGET_CLONES
void SlideDown(int32_t* columns, int enter, const int16_t* reference_enter, int leave,
               const int16_t* reference_leave) {
  for (int d = 0; d < kDisparities; ++d) {
    columns[d] += enter * reference_enter[d] - leave * reference_leave[d];
  }
}

CURVEFUSION_TARGET_CLONES
void SlideRight(int32_t* blocks, const int32_t* enter, const int32_t* leave) {
  for (int d = 0; d < kDisparities; ++d) blocks[d] += enter[d] - leave[d];
}

// The best correlation as an integer, with its disparity in the lowest bits, the least one on ties.
CURVEFUSION_TARGET_CLONES
int32_t BestKey(const int32_t* blocks, int32_t image_sum, float image_scale,
                const int32_t* reference_sum, const float* reference_scale) {
  int32_t best = 0;
  for (int d = 0; d < kDisparities; ++d) {
    const int32_t covariance = kBlockPixels * blocks[d] - image_sum * reference_sum[d];
    const float correlation = static_cast<float>(covariance) * reference_scale[d] * image_scale;
    const int32_t key =
        static_cast<int32_t>(correlation * kKeyScale) * (1 << kKeyShift) + (kDisparities - 1 - d);
    best = std::max(best, key);
  }
  return best;
}

CURVEFUSION_TARGET_CLONES
int32_t BlockProduct(const int16_t* patch, const int16_t* reference, int stride) {
  int32_t sum = 0;
  for (int row = 0; row < kBlock; ++row) {
    const int16_t* a = patch + row * kPatchStride;
    const int16_t* b = reference + static_cast<ptrdiff_t>(row) * stride;
    for (int column = 0; column < kPatchStride; ++column) {
      sum += static_cast<int32_t>(a[column]) * static_cast<int32_t>(b[column]);
    }
  }
  return sum;
}

template <class T>
Image<T> Reversed(const Image<T>& image) {
  Image<T> reversed(image.width(), image.height());
  for (int v = 0; v < image.height(); ++v) {
    std::reverse_copy(image.row(v), image.row(v) + image.width(), reversed.row(v));
  }
  return reversed;
}

}  // namespace

// The 9x9 block around a pixel and its moments.
struct BlockMatcher::Patch {
  alignas(32) int16_t values[kBlock * kPatchStride] = {};
  int32_t sum = 0;
  float scale = 0;

  Patch(const IntensityImage& image, const BlockMoments& moments, int u, int v)
      : sum(moments.sum(u, v)), scale(moments.scale(u, v)) {
    for (int row = 0; row < kBlock; ++row) {
      std::memcpy(values + row * kPatchStride, image.row(v - kHalf + row) + u - kHalf,
                  kBlock * sizeof(int16_t));
    }
  }
};

void VisitOptions(BlockMatchingOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"seed_correlation", "", 0, 1,
                 "Correlation at which a block match stands for itself; own choice."},
                options.seed_correlation);
  visitor.Visit(
      {"grow_correlation", "", 0, 1, "Correlation that a neighbour of a match needs; own choice."},
      options.grow_correlation);
  visitor.Visit({"drop_small_components", "", 0, 1,
                 "Whether the chip drops small components of depth; fitted to recordings."},
                options.drop_small_components);
  visitor.Visit({"min_component", "px", 1, 10000,
                 "Pixels of the smallest component that it keeps; fitted to recordings."},
                options.min_component);
  visitor.Visit({"component_step", "px", 0, 10,
                 "Largest step of disparity within a component; fitted to recordings."},
                options.component_step);
}

BlockMatcher::BlockMatcher(int width, int height, const Pattern& pattern,
                           const BlockMatchingOptions& options)
    : width_(width), height_(height), options_(options) {
  for (int shift = 0; shift < kSubpixels; ++shift) {
    // A patch's rows are read kPatchStride wide.
    Image<int16_t> intensity(kMargin + width + kPatchStride, height);
    for (int v = 0; v < height; ++v) {
      for (int x = 0; x < intensity.width(); ++x) {
        const double value = pattern(x - kMargin, shift, v);
        intensity(x, v) = static_cast<int16_t>(std::lround(value * kReferencePeak));
      }
    }
    BlockMoments moments = Moments(intensity);
    references_.push_back({std::move(intensity), std::move(moments.sum), std::move(moments.scale)});
  }
  reversed_intensity_ = Reversed(references_[0].intensity);
  reversed_sum_ = Reversed(references_[0].sum);
  reversed_scale_ = Reversed(references_[0].scale);
}

BlockMatcher::BlockMoments BlockMatcher::Moments(const IntensityImage& image) {
  BlockMoments moments{Image<int32_t>(image.width(), image.height(), 0),
                       Image<float>(image.width(), image.height(), 0.0f)};
  std::vector<int64_t> sums(image.width(), 0);
  std::vector<int64_t> squares(image.width(), 0);
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      const int64_t enter = image(u, v);
      const int64_t leave = v >= kBlock ? image(u, v - kBlock) : 0;
      sums[u] += enter - leave;
      squares[u] += enter * enter - leave * leave;
    }
    if (v < kBlock - 1) continue;
    int64_t sum = 0;
    int64_t square = 0;
    for (int u = 0; u < image.width(); ++u) {
      sum += sums[u] - (u >= kBlock ? sums[u - kBlock] : 0);
      square += squares[u] - (u >= kBlock ? squares[u - kBlock] : 0);
      if (u < kBlock - 1) continue;
      const int64_t variance = kBlockPixels * square - sum * sum;
      moments.sum(u - kHalf, v - kHalf) = static_cast<int32_t>(sum);
      if (variance > 0) {
        moments.scale(u - kHalf, v - kHalf) = 1.0f / std::sqrt(static_cast<float>(variance));
      }
    }
  }
  return moments;
}

Image<int16_t> BlockMatcher::BestDisparities(const IntensityImage& image,
                                             const BlockMoments& moments) const {
  Image<int16_t> disparities(width_, height_, 0);
  const auto seed_key = static_cast<int32_t>(options_.seed_correlation * kKeyScale) << kKeyShift;
  const int32_t last = reversed_intensity_.width() - 1 - kMargin + kMinDisparity;
  std::vector<int32_t> columns(static_cast<size_t>(width_) * kDisparities, 0);
  std::vector<int32_t> blocks(kDisparities);
  const std::vector<int32_t> nothing(kDisparities, 0);
  for (int row = 0; row < height_; ++row) {
    const int gone = std::max(row - kBlock, 0);
    for (int u = 0; u < width_; ++u) {
      SlideDown(&columns[static_cast<size_t>(u) * kDisparities], image(u, row),
                reversed_intensity_.row(row) + last - u, row >= kBlock ? image(u, gone) : 0,
                reversed_intensity_.row(gone) + last - u);
    }
    const int v = row - kHalf;
    if (v < kHalf) continue;
    std::fill(blocks.begin(), blocks.end(), 0);
    for (int right = 0; right < width_; ++right) {
      const int32_t* leave = right >= kBlock
                                 ? &columns[static_cast<size_t>(right - kBlock) * kDisparities]
                                 : nothing.data();
      SlideRight(blocks.data(), &columns[static_cast<size_t>(right) * kDisparities], leave);
      const int u = right - kHalf;
      if (u < kHalf || moments.scale(u, v) == 0) continue;
      const int32_t key =
          BestKey(blocks.data(), moments.sum(u, v), moments.scale(u, v),
                  reversed_sum_.row(v) + last - u, reversed_scale_.row(v) + last - u);
      if (key < seed_key) continue;
      const int from_end = key & ((1 << kKeyShift) - 1);
      disparities(u, v) = static_cast<int16_t>(kMinDisparity + kDisparities - 1 - from_end);
    }
  }
  return disparities;
}

float BlockMatcher::Correlation(const Patch& patch, int u, int v, int eighths) const {
  // Position u - eighths / 8, split into a whole column and a shift to the right.
  const int whole = (eighths + kSubpixels - 1) / kSubpixels;
  const Reference& reference = references_[whole * kSubpixels - eighths];
  const int x = u - whole + kMargin;
  const int32_t product = BlockProduct(patch.values, reference.intensity.row(v - kHalf) + x - kHalf,
                                       reference.intensity.width());
  const int32_t covariance = kBlockPixels * product - patch.sum * reference.sum(x, v);
  return static_cast<float>(covariance) * reference.scale(x, v) * patch.scale;
}

void BlockMatcher::Grow(const IntensityImage& image, const BlockMoments& moments,
                        Image<int16_t>& disparities) const {
  std::vector<std::pair<int, int>> queue;
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      if (disparities(u, v) > 0) queue.emplace_back(u, v);
    }
  }
  for (size_t next = 0; next < queue.size(); ++next) {
    const auto [from_u, from_v] = queue[next];
    const int disparity = disparities(from_u, from_v);
    for (const auto& [du, dv] : kPixelsBeside) {
      const int u = from_u + du;
      const int v = from_v + dv;
      if (u < kHalf || v < kHalf || u >= width_ - kHalf || v >= height_ - kHalf) continue;
      if (disparities(u, v) > 0) continue;
      const Patch patch(image, moments, u, v);
      float best = static_cast<float>(options_.grow_correlation);
      for (int d = disparity - 1; d <= disparity + 1; ++d) {
        if (d < kMinDisparity || d >= kMinDisparity + kDisparities) continue;
        const float correlation = Correlation(patch, u, v, d * kSubpixels);
        if (correlation < best) continue;
        best = correlation;
        disparities(u, v) = static_cast<int16_t>(d);
      }
      if (disparities(u, v) > 0) queue.emplace_back(u, v);
    }
  }
}

Image<float> BlockMatcher::Match(const IntensityImage& image) const {
  assert(image.width() == width_ && image.height() == height_);
  const BlockMoments moments = Moments(image);
  Image<int16_t> disparities = BestDisparities(image, moments);
  Grow(image, moments, disparities);
  Image<float> refined(width_, height_, 0.0f);
  for (int v = kHalf; v < height_ - kHalf; ++v) {
    for (int u = kHalf; u < width_ - kHalf; ++u) {
      if (disparities(u, v) == 0) continue;
      const Patch patch(image, moments, u, v);
      const int center = disparities(u, v) * kSubpixels;
      float best = -1;
      for (int eighths = center - kSubpixels / 2; eighths <= center + kSubpixels / 2; ++eighths) {
        const float correlation = Correlation(patch, u, v, eighths);
        if (correlation <= best) continue;
        best = correlation;
        refined(u, v) = static_cast<float>(eighths) / kSubpixels;
      }
    }
  }
  if (options_.drop_small_components) {
    DropSmallComponents(refined, options_.min_component, {.step = options_.component_step});
  }
  return refined;
}

}  // namespace curvefusion
