#pragma once

#include <functional>
#include <vector>

#include "capture/sequence.h"

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

}  // namespace curvefusion
