#include "apps/result_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <utility>

#include "apps/output_folder.h"
#include "kernel/error.h"
#include "kernel/file_set.h"
#include "kernel/json_input.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

constexpr const char* kLock = "curvefusion.lock";
constexpr const char* kReport = "report.json";
constexpr const char* kConfig = "config.toml";
constexpr const char* kPage = "report.html";
constexpr const char* kNothingReport = "report_nothing_found.json";
constexpr const char* kNothingConfig = "config_nothing_found.toml";
constexpr const char* kNothingPage = "report_nothing_found.html";

bool IsReport(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return false;
  try {
    const nlohmann::json report = ParseJson(ReadFile(path), path.string());
    return report.is_object() && report.value("format", "") == "curvefusion-report";
  } catch (const Error&) {
    return false;
  } catch (const nlohmann::json::exception&) {  // a format that is no text
    return false;
  }
}

// The first entry that no run of this program makes; empty where there is none.
std::string ForeignEntry(const fs::path& folder, const std::vector<fs::path>& extras) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool is_extra = std::any_of(extras.begin(), extras.end(), [&](const fs::path& extra) {
      std::error_code missing;
      return fs::equivalent(extra, entry.path(), missing);
    });
    if (name != kLock && !is_extra) return name;
  }
  return "";
}

void RequireOwn(const fs::path& folder, const std::vector<fs::path>& extras) {
  if (IsReport(folder / kReport) || IsReport(folder / kNothingReport)) return;
  const std::string foreign = ForeignEntry(folder, extras);
  if (foreign.empty()) return;
  throw Error(ErrorKind::kUsage,
              fmt::format("{}: holds {} and no result of an earlier run; name another folder, or "
                          "add --force to put the result beside what is there",
                          folder.string(), foreign));
}

void RequireNoneReplaced(const fs::path& folder) {
  if (IsReport(folder / kReport) || IsReport(folder / kNothingReport)) return;
  for (const std::string& name : ResultNames()) {
    if (!fs::exists(fs::symlink_status(folder / name))) continue;
    throw Error(ErrorKind::kUsage,
                fmt::format("{}: is not of an earlier run and would be overwritten, which --force "
                            "does not allow; move it or name another folder",
                            (folder / name).string()));
  }
}

}  // namespace

const std::vector<std::string>& ResultNames() {
  static const std::vector<std::string> names = {
      "skeleton.json", "uncertain.json",  "trajectory.txt", "mesh.ply", "hybrid.ply",
      "hybrid.stl",    "solid_parts.ply", "preview.png",    kPage,      kConfig,
      kNothingReport,  kNothingPage,      kNothingConfig,   kReport};
  return names;
}

ResultFolder::ResultFolder(fs::path folder, const std::vector<fs::path>& extras, bool force)
    : folder_(std::move(folder)) {
  MakeOutputFolder(folder_);
  lock_.emplace(folder_ / kLock, folder_);
  RecoverFileSet(folder_);
  if (force) {
    RequireNoneReplaced(folder_);
  } else {
    RequireOwn(folder_, extras);
  }
}

void ResultFolder::Replace(const Writer& write) const {
  WriteFilesTogether(folder_, ResultNames(), write);
}

bool ResultFolder::HoldsSkeleton() const { return fs::exists(folder_ / "skeleton.json"); }

std::string ResultFolder::NothingFoundName(const std::string& name) const {
  if (!HoldsSkeleton()) return name;
  const fs::path path = name;
  return path.stem().string() + "_nothing_found" + path.extension().string();
}

void ResultFolder::AddNothingFound(const Writer& write) const {
  if (!HoldsSkeleton()) {
    Replace(write);
    return;
  }
  const std::vector<std::string> names = {kNothingPage, kNothingConfig, kNothingReport};
  WriteFilesTogether(folder_, names, [&](const fs::path& temporary) {
    write(temporary);
    for (const char* name : {kPage, kConfig, kReport}) {
      fs::rename(temporary / name, temporary / NothingFoundName(name));
    }
  });
}

}  // namespace curvefusion
