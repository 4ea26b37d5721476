#include "capture/frame_stream.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr size_t kWindow = 8;  // frames; 640x480 takes 2.2 MB a frame

DecodedFrame DecodeFrame(const Sequence& sequence, int index, const FrameStreamOptions& options) {
  DecodedFrame frame;
  frame.index = index;
  if (options.depth) frame.depth = LoadDepth(sequence, index);
  if (options.color) frame.color = LoadColor(sequence, index);
  return frame;
}

}  // namespace

void ForEachFrame(const Sequence& sequence, const std::vector<int>& frames,
                  const FrameStreamOptions& options,
                  const std::function<void(const DecodedFrame&)>& body) {
  std::vector<DecodedFrame> window(std::min(kWindow, frames.size()));
  for (size_t begin = 0; begin < frames.size(); begin += kWindow) {
    const size_t end = std::min(begin + kWindow, frames.size());
    ParallelFor(0, static_cast<int64_t>(end - begin), 1, [&](int64_t i) {
      window[i] = DecodeFrame(sequence, frames[begin + static_cast<size_t>(i)], options);
    });
    for (size_t i = begin; i < end; ++i) body(window[i - begin]);
  }
}

void ForEachFrame(const Sequence& sequence, int first, int last, const FrameStreamOptions& options,
                  const std::function<void(const DecodedFrame&)>& body) {
  assert(0 <= first && first <= last && last <= sequence.frame_count());
  std::vector<int> frames(static_cast<size_t>(last - first));
  std::iota(frames.begin(), frames.end(), first);
  ForEachFrame(sequence, frames, options, body);
}

std::vector<int> AllFrames(const Sequence& sequence) {
  std::vector<int> frames(sequence.frames.size());
  std::iota(frames.begin(), frames.end(), 0);
  return frames;
}

std::vector<int> EvenlyThinned(const std::vector<int>& frames, int max_frames) {
  const auto count = static_cast<int64_t>(frames.size());
  if (count <= max_frames) return frames;
  std::vector<int> thinned;
  for (int64_t i = 0; i < max_frames; ++i) {
    thinned.push_back(frames[static_cast<size_t>((2 * i + 1) * count / (2 * max_frames))]);
  }
  return thinned;
}

}  // namespace curvefusion
