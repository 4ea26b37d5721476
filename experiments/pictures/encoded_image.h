#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <vector>

namespace curvefusion {

/// Writes an image in the format that the extension names, with OpenCV's parameters for it.
/// cv::imwrite does not tell whether all bytes arrived. Throws Error(kResource) where they did not.
void WriteEncoded(const std::filesystem::path& path, const cv::Mat& image,
                  const std::vector<int>& parameters = {});

}  // namespace curvefusion
