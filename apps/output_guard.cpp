#include "apps/output_guard.h"

#include <fmt/format.h>

#include <system_error>

#include "kernel/error.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

// The same file or folder, also through links; false where either is missing.
bool IsSame(const fs::path& a, const fs::path& b) {
  std::error_code missing;
  return fs::equivalent(a, b, missing);
}

// Without links as far as the path is there.
fs::path Resolved(const fs::path& path) {
  std::error_code failure;
  fs::path resolved = fs::weakly_canonical(fs::absolute(path), failure);
  return failure ? fs::absolute(path).lexically_normal() : resolved;
}

}  // namespace

void RequireApart(const std::vector<fs::path>& inputs, const fs::path& output) {
  if (output.empty()) return;
  for (const fs::path& input : inputs) {
    if (input.empty() || !(IsSame(input, output) || Resolved(input) == Resolved(output))) continue;
    throw Error(ErrorKind::kUsage,
                fmt::format("{}: is read by this command and would be overwritten; name another "
                            "place for the result",
                            output.string()));
  }
}

void RequireOutside(const fs::path& input_folder, const fs::path& output) {
  if (output.empty()) return;
  for (fs::path path = Resolved(output);; path = path.parent_path()) {
    if (IsSame(path, input_folder)) {
      throw Error(ErrorKind::kUsage,
                  fmt::format("{}: lies in the input {}, into which nothing is written; name a "
                              "place outside it",
                              output.string(), input_folder.string()));
    }
    if (path == path.parent_path()) return;
  }
}

}  // namespace curvefusion
