#include "kernel/partial_name.h"

#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "kernel/process_mark.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

const std::string& Mark() {
  static const std::string mark = ".partial-" + ProcessSpace() + "-";
  return mark;
}

// Removes the stale entries of a folder whose names pass.
void RemoveStale(const fs::path& folder, const std::function<bool(const std::string&)>& passes) {
  std::error_code failure;
  std::vector<fs::path> stale;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    const fs::path& path = entry->path();
    if (IsStalePartial(path) && passes(path.filename().string())) stale.push_back(path);
  }
  for (const fs::path& path : stale) fs::remove_all(path, failure);
}

}  // namespace

fs::path PartialFilePath(const fs::path& file) {
  fs::path temporary = file;
  temporary.replace_filename(
      fmt::format("{}{}{}{}", file.stem().string(), Mark(), ::getpid(), file.extension().string()));
  return temporary;
}

fs::path PartialFolderPath(const fs::path& folder) {
  return folder.string() + Mark() + std::to_string(::getpid());
}

bool IsStalePartial(const fs::path& path) {
  const std::string name = path.filename().string();
  const size_t begin = name.find(Mark());
  if (begin == std::string::npos) return false;
  const std::string_view rest = std::string_view(name).substr(begin + Mark().size());
  int pid = 0;
  const auto [end, failure] = std::from_chars(rest.data(), rest.data() + rest.size(), pid);
  const bool ends_there = end == rest.data() + rest.size() || *end == '.';
  return failure == std::errc() && pid > 0 && ends_there && IsGone(pid);
}

void RemoveStalePartials(const fs::path& final_path) {
  const std::string stem = final_path.stem().string() + Mark();
  const std::string extension = final_path.extension().string();
  const std::string whole = final_path.filename().string() + Mark();
  const fs::path folder = final_path.has_parent_path() ? final_path.parent_path() : ".";
  RemoveStale(folder, [&](const std::string& name) {
    return name.starts_with(whole) || (name.starts_with(stem) && name.ends_with(extension));
  });
}

void RemoveStalePartialsIn(const fs::path& folder) {
  RemoveStale(folder, [](const std::string&) { return true; });
}

}  // namespace curvefusion
