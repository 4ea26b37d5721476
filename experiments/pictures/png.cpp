#include "experiments/pictures/png.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "kernel/atomic_file.h"
#include "kernel/error.h"

namespace curvefusion {

void WritePng(const std::filesystem::path& path, const ColorImage& picture) {
  ColorImage copy = picture;  // OpenCV has no constant views
  cv::Mat image;
  cv::cvtColor(cv::Mat(copy.height(), copy.width(), CV_8UC3, copy.data()), image,
               cv::COLOR_RGB2BGR);
  WriteFileAtomically(path, [&](const std::filesystem::path& temporary) {
    if (!cv::imwrite(temporary.string(), image)) {
      throw Error(ErrorKind::kResource, path.string() + ": cannot be written");
    }
  });
}

}  // namespace curvefusion
