#pragma once

#include <filesystem>
#include <string>

#include "capture/finding.h"
#include "tests/temporary_path.h"

namespace curvefusion {

/// Writes text to a file, making its folders.
void WriteText(const std::filesystem::path& path, const std::string& text);

/// Writes a 16-bit PNG whose pixel (u, v) is `value` + u, clamped to 16 bits.
void WriteDepthPng(const std::filesystem::path& path, int width, int height, int value);

/// Writes an 8-bit grey PNG.
void WriteGreyPng(const std::filesystem::path& path, int width, int height);

/// Writes an orange image, RGB (200, 100, 50), as PNG or JPEG by its extension.
void WriteColor(const std::filesystem::path& path, int width, int height);

/// Cuts a file to a share of its length.
void Truncate(const std::filesystem::path& path, double share);

/// The length a healthy fixture sequence has.
inline constexpr int kFixtureFrames = 4;

/// A healthy TUM sequence of 32x24 images at 0.1 s steps: depth 1 m, camera moving along x by 10 mm
/// a frame.
void WriteTumSequence(const std::filesystem::path& folder);

/// The same with one pose file a frame, millimetres.
void WritePerFrameSequence(const std::filesystem::path& folder);

/// A handler that fails the test at any finding.
FindingHandler FailOnFinding();

}  // namespace curvefusion
