#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <type_traits>
#include <vector>

#include "capture/sequence.h"
#include "kernel/error.h"
#include "kernel/parallel.h"

namespace curvefusion {

/// Which images of a frame are decoded.
struct FrameStreamOptions {
  bool depth = true;
  bool color = true;
};

/// A frame with its images; those not asked for are empty.
struct DecodedFrame {
  int index = 0;  ///< in sequence.frames
  DepthImage depth;
  ColorImage color;
};

/// Calls body for each of the frames, in the order given, on the calling thread. Images are decoded
/// in parallel, a window of a few frames ahead, so memory does not grow with the number of frames;
/// the body may run parallel loops itself. Throws Error(kBadInput) where an image cannot be
/// decoded.
void ForEachFrame(const Sequence& sequence, const std::vector<int>& frames,
                  const FrameStreamOptions& options,
                  const std::function<void(const DecodedFrame&)>& body);

/// The same for the frames of [first, last).
void ForEachFrame(const Sequence& sequence, int first, int last, const FrameStreamOptions& options,
                  const std::function<void(const DecodedFrame&)>& body);

/// The indices of all frames of a sequence.
std::vector<int> AllFrames(const Sequence& sequence);

/// The frames, or max_frames of them that are evenly spread where there are more.
std::vector<int> EvenlyThinned(const std::vector<int>& frames, int max_frames);

/// What look gives of the colour images, as stored, of max_frames frames that are evenly spread, or
/// of all where there are fewer; looks are taken in parallel. Images that cannot be read are left
/// out: whoever needs one names it.
template <class Look>
auto OfStoredColors(const Sequence& sequence, int max_frames, const Look& look) {
  using Result = std::invoke_result_t<Look, const ColorImage&>;
  const std::vector<int> frames = EvenlyThinned(AllFrames(sequence), max_frames);
  std::vector<std::optional<Result>> found(frames.size());
  ParallelFor(0, static_cast<int64_t>(frames.size()), 1, [&](int64_t i) {
    const auto k = static_cast<size_t>(i);
    try {
      found[k] = look(LoadColorAsStored(sequence, frames[k]));
    } catch (const Error&) {
    }
  });
  std::vector<Result> results;
  for (std::optional<Result>& result : found) {
    if (result) results.push_back(std::move(*result));
  }
  return results;
}

}  // namespace curvefusion
