#include "capture/link_file.h"

#include <fmt/format.h>

#include <system_error>

#include "kernel/error.h"

namespace curvefusion {

void LinkFile(const std::filesystem::path& file, const std::filesystem::path& link) {
  std::error_code error;
  std::filesystem::create_symlink(std::filesystem::canonical(file), link, error);
  if (error) std::filesystem::create_hard_link(file, link, error);
  if (!error) return;
  throw Error(ErrorKind::kResource, fmt::format("{}: cannot link to {}: {}", link.string(),
                                                file.string(), error.message()));
}

}  // namespace curvefusion
