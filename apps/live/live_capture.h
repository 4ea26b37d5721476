#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "apps/live/live_board.h"
#include "apps/live/live_source.h"
#include "fusion/best/best_options.h"

namespace curvefusion {

/// The files that a live run renews after every bundle, in its folder.
inline constexpr const char* kSnapshotFile = "snapshot.json";
inline constexpr const char* kStateFile = "state.json";

/// What a capture needs besides its source.
struct LiveCapture {
  const BestOptions& options;
  std::filesystem::path folder;         ///< for snapshots
  std::function<bool()> wants_end;      ///< asked all the time: whether the user ends it
  std::function<void(double)> on_step;  ///< called all the time with the seconds so far
};

/// How a capture ended.
struct CaptureEnd {
  bool by_user = false;      ///< otherwise the source had no more
  std::string last_arrived;  ///< name of the last frame that came; empty where none did
};

/// Takes the frames of a source as they come; a thread of its own reconstructs them live and, after
/// each bundle, writes a snapshot and puts it on the board. Where it falls behind, frames are
/// dropped evenly (FrameQueue). Throws what LiveReconstruction and the source throw.
CaptureEnd CaptureLive(LiveSource& source, const LiveCapture& capture, LiveBoard& board);

/// Replaces the state file in the folder by what the board shows. Not while CaptureLive runs, which
/// does it after each snapshot.
void WriteState(const LiveBoard& board, const std::filesystem::path& folder);

}  // namespace curvefusion
