// The house has floors: includes run only downwards, and never between fusion and meshing or
// between capture and graph. This test reads every source file and fails on an include against the
// arrows.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "tests/temporary_path.h"

namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::set<std::string>> kMayInclude = {
    {"kernel", {"kernel"}},
    {"capture", {"capture", "kernel"}},
    {"graph", {"graph", "kernel"}},
    {"fusion", {"fusion", "capture", "graph", "kernel"}},
    {"meshing", {"meshing", "graph", "kernel"}},
    {"experiments", {"experiments", "fusion", "meshing", "capture", "graph", "kernel"}},
    {"apps", {"apps", "experiments", "fusion", "meshing", "capture", "graph", "kernel"}},
};

bool IsSource(const fs::path& path) {
  return path.extension() == ".h" || path.extension() == ".cpp";
}

// "file:line includes target" for every include of another folder that is not allowed.
std::vector<std::string> IncludesAgainstTheArrows(const fs::path& root, const std::string& folder) {
  const std::regex include_pattern(R"re(^\s*#\s*include\s*"([^/"]+)/[^"]*")re");
  std::vector<std::string> violations;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    if (!entry.is_regular_file() || !IsSource(entry.path())) continue;
    std::ifstream stream(entry.path());
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
      std::smatch match;
      if (!std::regex_search(line, match, include_pattern)) continue;
      if (kMayInclude.count(match[1]) == 0 || kMayInclude.at(folder).count(match[1]) == 0) {
        violations.push_back(entry.path().string() + ":" + std::to_string(number) + " includes " +
                             match[1].str());
      }
    }
  }
  return violations;
}

TEST(IncludeArrows, EveryIncludeRunsDownwards) {
  for (const auto& [folder, allowed] : kMayInclude) {
    for (const std::string& violation : IncludesAgainstTheArrows(CURVEFUSION_SOURCE_DIR, folder)) {
      ADD_FAILURE() << violation;
    }
  }
}

// The two profiles are built from the same kit: neither sees the other, nor does the kit see them.
TEST(IncludeArrows, ProfilesOfFusionKnowTheKitOnly) {
  const std::regex include_pattern(R"re(^\s*#\s*include\s*"fusion/(paper|best)/[^"]*")re");
  const fs::path fusion = fs::path(CURVEFUSION_SOURCE_DIR) / "fusion";
  int found = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fusion)) {
    const fs::path& path = entry.path();
    if (!entry.is_regular_file() || !IsSource(path) || path.stem() == "pipeline") continue;
    const std::string room = path.parent_path().filename().string();
    std::ifstream stream(path);
    for (std::string line; std::getline(stream, line);) {
      std::smatch match;
      if (!std::regex_search(line, match, include_pattern)) continue;
      EXPECT_EQ(match[1].str(), room) << path << ": " << line;
      ++found;
    }
  }
  EXPECT_GT(found, 10);  // includes are read at all
}

TEST(IncludeArrows, AnIncludeAgainstTheArrowsIsFound) {
  const fs::path root = curvefusion::TemporaryPath("include_arrows");
  fs::create_directories(root / "graph");
  std::ofstream(root / "graph" / "bad.cpp")
      << "#include <vector>\n#include \"fusion/pipeline.h\"\n";
  EXPECT_EQ(IncludesAgainstTheArrows(root, "graph").size(), 1u);
  fs::remove_all(root);
}

}  // namespace
