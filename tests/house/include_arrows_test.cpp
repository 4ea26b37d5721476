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

#include "tests/source_folder.h"
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
    {"python", {"python", "experiments", "fusion", "meshing", "capture", "graph", "kernel"}},
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
    for (const std::string& violation :
         IncludesAgainstTheArrows(curvefusion::SourceFolder(), folder)) {
      ADD_FAILURE() << violation;
    }
  }
}

// Within floors, rooms have arrows too. What a room may include besides its own files; a floor's
// files outside of its rooms are the room "". The two profiles of fusion know the kit only, and the
// kit neither of them: pipeline alone chooses between them. Live is the best profile frame by
// frame.
const std::map<std::string, std::map<std::string, std::set<std::string>>> kRoomsMayInclude = {
    {"graph", {{"", {}}, {"contraction", {""}}, {"io", {""}}}},
    {"meshing", {{"", {}}, {"io", {""}}}},
    {"fusion",
     {{"volume", {}},
      {"appearance", {}},
      {"strips", {"appearance"}},
      {"registration", {}},
      {"segmentation", {"", "appearance", "nets", "volume"}},
      {"adjustment", {"appearance", "registration", "strips"}},
      {"silhouettes", {"adjustment", "appearance", "curve_graph", "segmentation", "strips"}},
      {"curve_graph", {"appearance", "strips"}},
      {"tracking", {"volume"}},
      {"nets", {"appearance", "tracking"}},
      {"paper", {"", "segmentation", "strips", "volume"}},
      {"best",
       {"", "adjustment", "appearance", "curve_graph", "nets", "registration", "segmentation",
        "silhouettes", "strips", "tracking", "volume"}},
      {"shards", {"appearance", "best"}},
      {"solid_parts", {"volume"}},
      {"live", {"best", "registration", "segmentation", "volume"}},
      {"", {"best", "curve_graph", "paper", "silhouettes", "strips", "volume"}}}},
};

struct RoomInclude {
  std::string from;
  std::string to;
  std::string place;  // file:line
};

std::string RoomOf(const fs::path& in_floor) {
  const fs::path room = in_floor.parent_path();
  return room.empty() ? "" : room.begin()->string();
}

std::vector<RoomInclude> IncludesBetweenRooms(const fs::path& root, const std::string& floor) {
  const std::regex include_pattern("^\\s*#\\s*include\\s*\"" + floor + "/([^\"]*)\"");
  std::vector<RoomInclude> includes;
  for (const auto& entry : fs::recursive_directory_iterator(root / floor)) {
    if (!entry.is_regular_file() || !IsSource(entry.path())) continue;
    const std::string from = RoomOf(fs::relative(entry.path(), root / floor));
    std::ifstream stream(entry.path());
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
      std::smatch match;
      if (!std::regex_search(line, match, include_pattern)) continue;
      const std::string to = RoomOf(match[1].str());
      const std::string place = entry.path().string() + ":" + std::to_string(number);
      if (from != to) includes.push_back({from, to, place});
    }
  }
  return includes;
}

TEST(IncludeArrows, RoomsOfAFloorKnowOnlyThoseTheyMay) {
  for (const auto& [floor, rooms] : kRoomsMayInclude) {
    const std::vector<RoomInclude> includes =
        IncludesBetweenRooms(curvefusion::SourceFolder(), floor);
    EXPECT_GT(includes.size(), 5u) << floor;  // includes are read at all
    for (const RoomInclude& include : includes) {
      const auto room = rooms.find(include.from);
      ASSERT_NE(room, rooms.end()) << floor << " has a room that has no arrows: " << include.from;
      EXPECT_EQ(room->second.count(include.to), 1u) << include.place << ": " << include.to;
    }
  }
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
