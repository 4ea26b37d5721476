#pragma once

#include <filesystem>
#include <vector>

#include "capture/content/thumbnails.h"
#include "capture/trajectory.h"

namespace curvefusion {

inline constexpr int kRoomFrames = 60;
inline constexpr double kRoomFrameRate = 30;

/// A scan of a room: floor, walls and three boxes with chequered sides, seen by a camera in a hand
/// that sways, 80x60 pixels, 60 frames at 30 a second. Depth and colour are exact but for the
/// rounding of their values.
struct RoomScan {
  Sequence sequence;  ///< poses are right; no image file is there
  Thumbnails thumbnails;
};

/// `sway` scales the motion; 0 is a camera that stands still.
RoomScan MakeRoomScan(double sway = 1);

/// The same before one wall that it faces: its depth does not tell poses apart.
RoomScan MakeWallScan();

/// Writes the images and lists of a room scan as a TUM sequence.
void WriteRoomScan(const RoomScan& scan, const std::filesystem::path& folder);

}  // namespace curvefusion
