#include "experiments/pictures/encoded_image.h"

#include <opencv2/imgcodecs.hpp>
#include <ostream>

#include "kernel/atomic_file.h"
#include "kernel/error.h"

namespace curvefusion {

void WriteEncoded(const std::filesystem::path& path, const cv::Mat& image,
                  const std::vector<int>& parameters) {
  std::vector<unsigned char> bytes;
  if (!cv::imencode(path.extension().string(), image, bytes, parameters)) {
    throw Error(ErrorKind::kResource, path.string() + ": cannot be encoded");
  }
  WriteStreamAtomically(path, [&](std::ostream& stream) {
    stream.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
  });
}

}  // namespace curvefusion
