#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "kernel/progress.h"

namespace curvefusion {

/// What became of the videos of a scan.
struct UnpackedVideos {
  std::map<std::string, int> images;  ///< by the name of their folder
  double untrusted_share = 0;         ///< of the measured depth, left out for its low confidence
};

/// The videos in a folder that stand for folders of images: one of colour (rgb, color, colour,
/// image, images) and one of depth, as .mp4, .mov, .mkv or .avi, where the images are not there. In
/// the order of their names.
std::vector<std::filesystem::path> VideosOf(const std::filesystem::path& scan);

/// What to do about the videos of a folder, as a sentence; empty where it holds none.
std::string VideoRemedy(const std::filesystem::path& scan);

/// Writes a scan, whose images cannot be read in any order from its videos, as a folder of images:
/// rgb.mp4 as rgb/000000.jpg and so on, a depth video as 16-bit PNG. Where there are confidence/
/// and depth/, as of the app Stray Scanner, depth of the lowest confidence (0) is left out. All
/// else becomes links. The folder gets its name when it is complete. Runs the programs ffmpeg and
/// ffprobe. Throws Error(kBadInput) where nothing is to be unpacked, depth was not stored in 16
/// bits without loss, or the videos have different frame rates; Error(kUsage) where `folder` is
/// there and not empty; Error(kResource) where ffmpeg is missing or fails.
UnpackedVideos UnpackVideos(const std::filesystem::path& scan, const std::filesystem::path& folder,
                            const Progress& progress);

}  // namespace curvefusion
