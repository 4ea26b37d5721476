// Memory does not grow with the number of frames: a long scan made of links to the frames of a
// short one, forth and back, so that the camera moves evenly.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <utility>
#include <vector>

#include "capture/decoded_images.h"
#include "tests/faults/trials.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

constexpr double kMegabyte = 1e6;
constexpr double kFrameRate = 30;

// The lines of a list, cut at their first blank: a time and the rest.
std::vector<std::pair<std::string, std::string>> Lines(const fs::path& path) {
  std::vector<std::pair<std::string, std::string>> lines;
  std::ifstream stream(path);
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line[0] == '#') continue;
    const size_t blank = line.find(' ');
    lines.emplace_back(line.substr(0, blank), line.substr(blank + 1));
  }
  return lines;
}

// A TUM sequence of so many frames from one whose images and poses have the same times.
void LinkScan(const fs::path& scan, int frames, const fs::path& linked) {
  const auto colors = Lines(scan / "rgb.txt"), depths = Lines(scan / "depth.txt");
  const auto poses = Lines(scan / "trajectory.txt");
  for (const char* folder : {"rgb", "depth"}) fs::create_directories(linked / folder);
  fs::create_symlink(scan / "intrinsics.json", linked / "intrinsics.json");
  std::ofstream color_list(linked / "rgb.txt"), depth_list(linked / "depth.txt");
  std::ofstream trajectory(linked / "trajectory.txt");
  const int last = static_cast<int>(poses.size()) - 1;
  for (int frame = 0; frame < frames; ++frame) {
    const int step = frame % (2 * last);
    const int source = std::min(step, 2 * last - step);
    const std::string time = fmt::format("{:.6f}", 1000 + frame / kFrameRate);
    const std::string color = "rgb/" + time + fs::path(colors[source].second).extension().string();
    const std::string depth = "depth/" + time + ".png";
    fs::create_symlink(scan / colors[source].second, linked / color);
    fs::create_symlink(scan / depths[source].second, linked / depth);
    color_list << time << ' ' << color << '\n';
    depth_list << time << ' ' << depth << '\n';
    trajectory << time << ' ' << poses[source].second << '\n';
  }
}

double PeakMegabytes(const TrialFolder& folder, const fs::path& scan, int frames, double longest) {
  folder.Prepare({});
  LinkScan(scan, frames, folder.path() / "linked");
  const ProgramRun run =
      RunProgram(folder.path(), {"reconstruct", "linked", "-o", "out", "--quiet", "--threads", "2"},
                 {.signal_after = longest});
  EXPECT_EQ(run.exit_code, 0) << run.output;
  fmt::print("reconstruct    {:>6} frames of 640x480: {:.0f} MB, {:.0f} s\n", frames,
             run.peak_bytes / kMegabyte, run.seconds);
  return run.peak_bytes / kMegabyte;
}

TEST(MemoryTest, DoesNotGrowWithTheNumberOfFrames) {
  if (!CanInjectFaults()) GTEST_SKIP() << "a sanitizer takes memory of its own";
  const TrialFolder folder;
  if (!TriesEverything()) {
    // A hand's 5 mm from frame to frame: curves are adjusted to every third one.
    const ProgramRun run =
        RunProgram(folder.inputs(), {"simulate", "object.json", "-o", "slow", "--sensor", "ideal",
                                     "--poses", "true", "--frames", "10", "--quiet"});
    ASSERT_EQ(run.exit_code, 0) << run.output;
    // Without images 255 MB. All of them, of .6 (depth) and .9 MB (colour), would be 230 MB more.
    constexpr double kImages = static_cast<double>(DecodedImages::kMaxBytes) / kMegabyte;
    EXPECT_LT(PeakMegabytes(folder, folder.inputs() / "slow", 150, 300), 300 + kImages);
    return;
  }
  const ProgramRun run = RunProgram(folder.inputs(), {"simulate", "cubeframe", "-o", "long",
                                                      "--frames", "150", "--seed", "1", "--quiet"});
  ASSERT_EQ(run.exit_code, 0) << run.output;
  for (const int frames : {500, 2000, 10000}) {
    EXPECT_LT(PeakMegabytes(folder, folder.inputs() / "long", frames, 4 * 3600), 2000);
  }
}

}  // namespace
}  // namespace curvefusion
