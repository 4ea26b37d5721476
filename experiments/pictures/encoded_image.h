#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <vector>

namespace curvefusion {

/// The bytes of an image in the format that the extension of `name` names, with OpenCV's parameters
/// for it. Throws Error(kResource) naming `name` where memory does not suffice.
std::vector<unsigned char> EncodeImage(const std::filesystem::path& name, const cv::Mat& image,
                                       const std::vector<int>& parameters = {});

/// Writes an image in the format that the extension names, with OpenCV's parameters for it.
/// cv::imwrite does not tell whether all bytes arrived. Throws Error(kResource) where they did not.
void WriteEncoded(const std::filesystem::path& path, const cv::Mat& image,
                  const std::vector<int>& parameters = {});

}  // namespace curvefusion
