#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "kernel/image.h"

namespace curvefusion {

/// Images of a sequence that were decoded once and are kept, as stored, up to so many bytes. The
/// first ones stay: stages go through all frames in the same order, and would never meet again one
/// that makes room for the next. Thread-safe.
class DecodedImages {
 public:
  // Chosen: the depth of 200 frames of 640x480, half of what all else of a run takes.
  static constexpr size_t kMaxBytes = size_t{128} << 20;

  explicit DecodedImages(size_t max_bytes = kMaxBytes) : max_bytes_(max_bytes) {}

  /// The depth or colour image of that name, which `decode` gives where it is not kept yet.
  std::shared_ptr<const Image<uint16_t>> Depth(const std::string& name,
                                               const std::function<Image<uint16_t>()>& decode);
  std::shared_ptr<const ColorImage> Color(const std::string& name,
                                          const std::function<ColorImage()>& decode);

  size_t bytes() const;

 private:
  template <class T>
  using Kept = std::map<std::string, std::shared_ptr<const Image<T>>>;

  template <class T>
  std::shared_ptr<const Image<T>> Get(Kept<T>& kept, const std::string& name,
                                      const std::function<Image<T>()>& decode);

  const size_t max_bytes_;
  mutable std::mutex mutex_;
  size_t bytes_ = 0;
  Kept<uint16_t> depth_;
  Kept<Rgb> color_;
};

}  // namespace curvefusion
