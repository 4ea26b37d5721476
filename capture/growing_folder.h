#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "capture/sequence.h"

namespace curvefusion {

/// A sequence of the layout with one pose a frame (docs/formats_input.md) while a camera writes it:
/// intrinsics.json, color/, depth/ and, unless poses are not asked for, pose/. Files may appear in
/// any order and grow in place. A frame is there once its files are complete: PNG and JPEG files
/// with their last bytes, poses with all their numbers. What is still incomplete when a later frame
/// is there has been passed over.
class GrowingFolder {
 public:
  GrowingFolder(std::filesystem::path folder, bool use_poses);

  /// The cameras, without frames; nothing before intrinsics.json is complete and both folders are
  /// there. Throws Error(kBadInput) for cameras that cannot be, and for text that is no JSON once
  /// nobody has written to it for 2 s.
  std::optional<Sequence> Cameras() const;

  /// The frames that have become complete since the last call, in ascending order, none earlier
  /// than those of that call. Linear in the files of the folder.
  std::vector<SequenceFrame> NewFrames();

  /// Whether whoever writes has left a file `end`: nothing more will come.
  bool HasEnded() const;

 private:
  std::filesystem::path folder_;
  bool use_poses_;
  long long last_number_ = -1;
};

}  // namespace curvefusion
