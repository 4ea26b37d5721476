#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kernel/camera.h"
#include "kernel/image.h"

namespace curvefusion {

/// Depth units per metre in the files.
inline constexpr double kDepthScale = 5000;

/// Time of a frame in seconds.
double FrameTime(int frame, double frame_rate);

/// Name of a frame, from which its files are named too: its time.
std::string FrameName(int frame, double frame_rate);

/// Depth in metres as a 16-bit PNG in units of 1/5000 m, rounded; beyond 13.1 m invalid.
void WriteDepthPng(const std::filesystem::path& path, const DepthImage& depth);

/// Colour as a JPEG of quality 95.
void WriteColorJpeg(const std::filesystem::path& path, const ColorImage& color);

/// rgb.txt, depth.txt and associations.txt of frames whose images are called rgb/NAME.jpg and
/// depth/NAME.png.
void WriteFrameLists(const std::filesystem::path& folder, const std::vector<std::string>& names);

/// intrinsics.json; the colour camera and its place only where they differ.
void WriteIntrinsics(const std::filesystem::path& path, const PinholeCamera& depth_camera,
                     const PinholeCamera& color_camera, const RigidTransform& T_color_depth);

}  // namespace curvefusion
