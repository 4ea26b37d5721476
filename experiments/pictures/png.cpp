#include "experiments/pictures/png.h"

#include <opencv2/imgproc.hpp>

#include "experiments/pictures/encoded_image.h"

namespace curvefusion {

void WritePng(const std::filesystem::path& path, const ColorImage& picture) {
  ColorImage copy = picture;  // OpenCV has no constant views
  cv::Mat image;
  cv::cvtColor(cv::Mat(copy.height(), copy.width(), CV_8UC3, copy.data()), image,
               cv::COLOR_RGB2BGR);
  WriteEncoded(path, image);
}

}  // namespace curvefusion
