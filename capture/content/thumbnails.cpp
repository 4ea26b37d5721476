#include "capture/content/thumbnails.h"

#include <algorithm>

#include "capture/image_file.h"
#include "kernel/error.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Pixels in a row. Chosen: 128 give 12,000 points a frame, of which the comparison takes some
// 1,400; at 64 the wires' surroundings are too coarse for slanted surfaces.
constexpr int kWidth = 128;

int Stride(const PinholeCamera& camera) { return std::max(1, camera.width / kWidth); }

bool HasSizeOf(const PinholeCamera& camera, int width, int height) {
  return camera.width > 0 && camera.width == width && camera.height == height;
}

// The camera of every `stride`-th pixel, the first at `offset`.
PinholeCamera Thinned(const PinholeCamera& camera, int stride, double offset) {
  return {camera.width / stride, camera.height / stride,        camera.fx / stride,
          camera.fy / stride,    (camera.cx - offset) / stride, (camera.cy - offset) / stride};
}

int SquareMean(const ColorImage& color, int u, int v, int stride) {
  int sum = 0;
  for (int y = v * stride; y < (v + 1) * stride; ++y) {
    const Rgb* row = color.row(y);
    for (int x = u * stride; x < (u + 1) * stride; ++x)
      sum += row[x][0] + 2 * row[x][1] + row[x][2];
  }
  return sum / (4 * stride * stride);
}

}  // namespace

Thumbnails EmptyThumbnails(const Sequence& sequence) {
  Thumbnails thumbnails;
  if (sequence.depth_camera.width <= 0 || sequence.color_camera.width <= 0) return thumbnails;
  const int depth_stride = Stride(sequence.depth_camera);
  const int color_stride = Stride(sequence.color_camera);
  thumbnails.depth_camera = Thinned(sequence.depth_camera, depth_stride, depth_stride / 2);
  thumbnails.color_camera = Thinned(sequence.color_camera, color_stride, 0.5 * (color_stride - 1));
  thumbnails.depth.resize(sequence.frames.size());
  thumbnails.grey.resize(sequence.frames.size());
  return thumbnails;
}

Image<uint16_t> ShrunkDepth(const Sequence& sequence, const Image<uint16_t>& raw) {
  if (!HasSizeOf(sequence.depth_camera, raw.width(), raw.height())) return {};
  const int stride = Stride(sequence.depth_camera);
  Image<uint16_t> shrunk(raw.width() / stride, raw.height() / stride);
  for (int v = 0; v < shrunk.height(); ++v) {
    for (int u = 0; u < shrunk.width(); ++u) {
      const uint16_t value = raw(u * stride + stride / 2, v * stride + stride / 2);
      shrunk(u, v) = value == sequence.invalid_depth ? uint16_t{0} : value;
    }
  }
  return shrunk;
}

Image<uint8_t> ShrunkColor(const Sequence& sequence, const ColorImage& color) {
  if (!HasSizeOf(sequence.color_camera, color.width(), color.height())) return {};
  const int stride = Stride(sequence.color_camera);
  Image<uint8_t> shrunk(color.width() / stride, color.height() / stride);
  for (int v = 0; v < shrunk.height(); ++v) {
    for (int u = 0; u < shrunk.width(); ++u) {
      shrunk(u, v) = static_cast<uint8_t>(SquareMean(color, u, v, stride));
    }
  }
  return shrunk;
}

Thumbnails DepthThumbnails(const Sequence& sequence, const std::vector<int>& frames) {
  Thumbnails thumbnails = EmptyThumbnails(sequence);
  if (thumbnails.depth.empty()) return thumbnails;
  ParallelFor(0, static_cast<int64_t>(frames.size()), 1, [&](int64_t i) {
    const auto frame = static_cast<size_t>(frames[static_cast<size_t>(i)]);
    try {
      const SequenceFrame& entry = sequence.frames[frame];
      thumbnails.depth[frame] =
          ShrunkDepth(sequence, DecodeDepthImage(entry.depth_path, entry.depth_part));
    } catch (const Error&) {
      thumbnails.depth[frame] = {};
    }
  });
  return thumbnails;
}

}  // namespace curvefusion
