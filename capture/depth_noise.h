#pragma once

namespace curvefusion {

/// Standard deviation of a Kinect V1's depth over the square of the depth, 1/m (Khoshelham and
/// Elberink 2012); generous for other cameras.
inline constexpr double kNoisePerSquaredDepth = 1.425e-3;

/// A step between neighbouring pixels of one surface over the square of the depth, 1/m: 3.5
/// standard deviations.
inline constexpr double kStepPerSquaredDepth = 0.005;

/// Pixels beside an outline that may have the depth within: block matching widens outlines. Chosen.
inline constexpr double kBesidePx = 1;

/// What lies so many standard deviations before a surface is none of it, CurveFusion 4.1.
inline constexpr double kClearDeviations = 3;

/// Standard deviation at a depth, metres.
inline double DepthNoise(double depth) { return kNoisePerSquaredDepth * depth * depth; }

}  // namespace curvefusion
