#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "capture/sequence.h"

namespace curvefusion {

/// A frame and when it came, in seconds of the clock that the source is asked with.
struct ArrivedFrame {
  SequenceFrame frame;
  double arrival = 0;
};

/// Where the frames of a live run come from. Times never go back from call to call.
class LiveSource {
 public:
  virtual ~LiveSource() = default;
  /// The cameras, without frames; nothing as long as they are not known.
  virtual std::optional<Sequence> Cameras() = 0;
  /// The frames that have come since the last call, the earliest first.
  virtual std::vector<ArrivedFrame> Arrived(double now) = 0;
  /// Whether no more will come.
  virtual bool HasEnded(double now) = 0;
};

/// A whole sequence whose frames come one after the other, the first with the first call: in steps
/// of their stamps, or `rate` a second where it is not 0 and where the stamps are no times.
std::unique_ptr<LiveSource> ReplayOf(Sequence sequence, double rate);

/// A folder that a camera writes (GrowingFolder). It ends with its file `end`, or `idle` seconds
/// after the last frame; before the first one it is waited for without limit.
std::unique_ptr<LiveSource> FollowFolder(const std::filesystem::path& folder, bool use_poses,
                                         double idle);

/// A folder that is unpacked from a tar archive on standard input while it comes, and followed. It
/// ends with the archive. Throws Error(kBadInput) for input that is no archive, ends in the midst
/// or leads out of the folder, Error(kResource) where nothing can be written.
std::unique_ptr<LiveSource> ReceiveFolder(const std::filesystem::path& folder, bool use_poses);

}  // namespace curvefusion
