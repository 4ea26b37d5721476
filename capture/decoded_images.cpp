#include "capture/decoded_images.h"

namespace curvefusion {

template <class T>
std::shared_ptr<const Image<T>> DecodedImages::Get(Kept<T>& kept, const std::string& name,
                                                   const std::function<Image<T>()>& decode) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = kept.find(name);
    if (found != kept.end()) return found->second;
  }
  auto image = std::make_shared<const Image<T>>(decode());
  const size_t bytes = image->size() * sizeof(T);
  const std::lock_guard lock(mutex_);
  if (bytes_ + bytes <= max_bytes_ && kept.emplace(name, image).second) bytes_ += bytes;
  return image;
}

std::shared_ptr<const Image<uint16_t>> DecodedImages::Depth(
    const std::string& name, const std::function<Image<uint16_t>()>& decode) {
  return Get(depth_, name, decode);
}

std::shared_ptr<const ColorImage> DecodedImages::Color(const std::string& name,
                                                       const std::function<ColorImage()>& decode) {
  return Get(color_, name, decode);
}

size_t DecodedImages::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

}  // namespace curvefusion
