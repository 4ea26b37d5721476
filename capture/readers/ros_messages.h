#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "capture/distortion.h"
#include "kernel/camera.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// Messages of ROS as they are serialised in a bag. All parsers throw Error(kBadInput), naming
/// `where`, for what is cut off or cannot be.

/// The head of a sensor_msgs/Image, without its pixels.
struct RosImage {
  double stamp = 0;  ///< seconds
  int width = 0;
  int height = 0;
  std::string encoding;  ///< "mono16", "rgb8"
  bool is_big_endian = false;
  std::uint32_t row_bytes = 0;
  std::uint32_t pixel_bytes = 0;   ///< of all rows
  std::uint64_t pixel_offset = 0;  ///< of the first pixel in the message
};

/// The most that the head of an image message takes here: frame names are some ten characters.
inline constexpr std::uint64_t kMaxRosImageHead = 4096;

/// `head` is the beginning of the message, up to kMaxRosImageHead bytes.
RosImage ParseRosImage(const std::string& head, const std::string& where);

/// Size, intrinsics and lens of a sensor_msgs/CameraInfo.
struct RosCamera {
  PinholeCamera camera;
  std::string lens;  ///< name of the model: "plumb_bob", or as RealSense calls it
  std::vector<double> coefficients;
};

RosCamera ParseCameraInfo(const std::string& message, const std::string& where);

/// A geometry_msgs/Transform.
RigidTransform ParseTransform(const std::string& message, const std::string& where);

/// A std_msgs/Float32.
float ParseFloat(const std::string& message, const std::string& where);

}  // namespace curvefusion
