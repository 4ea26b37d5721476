#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "capture/finding.h"
#include "capture/sequence.h"

namespace curvefusion {

/// An image of a recording that is not yet paired.
struct RecordedImage {
  double stamp = 0;     ///< seconds, of the camera
  double recorded = 0;  ///< seconds, of the recorder; the stamp where it has no clock of its own
  ImagePart part;
};

/// The images of one camera in a recording.
struct RecordedStream {
  std::string name;  ///< what messages call it
  std::vector<RecordedImage> images;
};

/// Adds a frame without a pose for each depth image that has a colour image of the same time,
/// within 20 ms: by their stamps or, where fewer than half of them meet and so have two clocks, by
/// the times of the recorder. Puts them in the order of the depth stamps; counts the others as
/// dropped.
void AddRecordedFrames(const std::filesystem::path& file, RecordedStream depth,
                       RecordedStream color, const FindingHandler& on_finding, Sequence& sequence);

}  // namespace curvefusion
