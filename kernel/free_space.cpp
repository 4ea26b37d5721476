#include "kernel/free_space.h"

#include <fmt/format.h>

#include <string>
#include <system_error>

#include "kernel/error.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

// "1.23 GB", "45.6 MB" or "0.789 MB".
std::string Amount(std::uintmax_t bytes) {
  const double megabytes = static_cast<double>(bytes) / 1e6;
  return megabytes < 1000 ? fmt::format("{:.3g} MB", megabytes)
                          : fmt::format("{:.3g} GB", megabytes / 1000);
}

}  // namespace

void RequireFreeSpace(const fs::path& place, std::uintmax_t bytes) {
  std::error_code failure;
  fs::path there = fs::absolute(place).lexically_normal();
  while (!fs::exists(there, failure) && there != there.parent_path()) there = there.parent_path();
  const fs::space_info space = fs::space(there, failure);
  if (failure || space.available >= bytes) return;  // what cannot be told may be enough
  throw Error(ErrorKind::kResource,
              fmt::format("{}: up to {} may be needed there and {} are free; make room or name "
                          "another place",
                          place.string(), Amount(bytes), Amount(space.available)));
}

}  // namespace curvefusion
