#include "experiments/pictures/encoded_image.h"

#include <opencv2/imgcodecs.hpp>
#include <ostream>

#include "kernel/atomic_file.h"
#include "kernel/error.h"

namespace curvefusion {

// OpenCV tells by its return value or by an exception of any kind that memory has run out.
std::vector<unsigned char> EncodeImage(const std::filesystem::path& name, const cv::Mat& image,
                                       const std::vector<int>& parameters) {
  std::vector<unsigned char> bytes;
  try {
    if (cv::imencode(name.extension().string(), image, bytes, parameters)) return bytes;
  } catch (const cv::Exception&) {
  }
  throw Error(ErrorKind::kResource,
              name.string() + ": cannot be encoded; is there memory for its image?");
}

void WriteEncoded(const std::filesystem::path& path, const cv::Mat& image,
                  const std::vector<int>& parameters) {
  const std::vector<unsigned char> bytes = EncodeImage(path, image, parameters);
  WriteStreamAtomically(path, [&](std::ostream& stream) {
    stream.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
  });
}

}  // namespace curvefusion
