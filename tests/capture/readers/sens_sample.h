#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/capture/content/room_scan.h"

namespace curvefusion {

/// A recording in the layout that ScanNet publishes with its SensReader (version 4), to be spoiled
/// before it is written.
struct SensSample {
  using Matrix = std::array<float, 16>;  ///< row by row
  struct Frame {
    Matrix camera_to_world;
    std::uint64_t color_stamp = 0, depth_stamp = 0;  ///< microseconds
    std::string color, depth;                        ///< as they are stored
  };

  std::uint32_t version = 4;
  std::string sensor = "StructureSensor";
  Matrix intrinsic_color{}, extrinsic_color{}, intrinsic_depth{}, extrinsic_depth{};
  std::int32_t color_compression = 2;  ///< JPEG
  std::int32_t depth_compression = 1;  ///< zlib
  std::array<std::uint32_t, 2> color_size{}, depth_size{};
  float depth_shift = 1000;
  std::vector<Frame> frames;

  /// The file from its first to its last byte, with a list of IMU frames that is empty.
  std::string Bytes() const;
};

/// A scan of room_scan.h: colour as PNG of its 80x60 pixels, deflated depth in 1/5000 m, stamps
/// of 30 frames a second, the colour of each 4 ms after its depth.
SensSample RoomAsSens(const RoomScan& scan);

/// 16-bit depth as zlib packs it.
std::string Deflated(const std::string& bytes);

void WriteBytes(const std::filesystem::path& path, const std::string& bytes);

}  // namespace curvefusion
