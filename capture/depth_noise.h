#pragma once

namespace curvefusion {

/// Standard deviation of a Kinect V1's depth over the square of the depth, 1/m (Khoshelham and
/// Elberink 2012); generous for other cameras.
inline constexpr double kNoisePerSquaredDepth = 1.425e-3;

}  // namespace curvefusion
