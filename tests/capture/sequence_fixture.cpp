#include "tests/capture/sequence_fixture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

namespace curvefusion {

namespace {

constexpr const char* kIntrinsics =
    R"({"width":32,"height":24,"fx":30,"fy":30,"cx":15.5,"cy":11.5})";

}  // namespace

void WriteText(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

void WriteDepthPng(const std::filesystem::path& path, int width, int height, int value) {
  std::filesystem::create_directories(path.parent_path());
  cv::Mat pixels(height, width, CV_16UC1);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u)
      pixels.at<uint16_t>(v, u) = cv::saturate_cast<uint16_t>(value + u);
  }
  cv::imwrite(path.string(), pixels);
}

void WriteGreyPng(const std::filesystem::path& path, int width, int height) {
  std::filesystem::create_directories(path.parent_path());
  cv::imwrite(path.string(), cv::Mat(height, width, CV_8UC1, cv::Scalar(90)));
}

void WriteColor(const std::filesystem::path& path, int width, int height) {
  std::filesystem::create_directories(path.parent_path());
  cv::imwrite(path.string(), cv::Mat(height, width, CV_8UC3, cv::Scalar(50, 100, 200)));
}

void Truncate(const std::filesystem::path& path, double share) {
  const auto size = static_cast<double>(std::filesystem::file_size(path));
  std::filesystem::resize_file(path, static_cast<uintmax_t>(size * share));
}

void WriteTumSequence(const std::filesystem::path& folder) {
  std::string rgb = "# colour\n";
  std::string depth;
  std::string trajectory = "# t tx ty tz qx qy qz qw\n";
  for (int i = 0; i < kFixtureFrames; ++i) {
    const double t = 10 + 0.1 * i;
    WriteColor(folder / fmt::format("rgb/{}.jpg", i), 32, 24);
    WriteDepthPng(folder / fmt::format("depth/{}.png", i), 32, 24, 5000);
    rgb += fmt::format("{:.3f} rgb/{}.jpg\n", t + 0.004, i);
    depth += fmt::format("{:.3f} depth/{}.png\n", t, i);
    trajectory += fmt::format("{:.3f} {} 0 0 0 0 0 1\n", t - 0.003, 0.01 * i);
  }
  WriteText(folder / "rgb.txt", rgb);
  WriteText(folder / "depth.txt", depth);
  WriteText(folder / "trajectory.txt", trajectory);
  WriteText(folder / "intrinsics.json", kIntrinsics);
}

void WritePerFrameSequence(const std::filesystem::path& folder) {
  for (int i = 0; i < kFixtureFrames; ++i) {
    WriteColor(folder / fmt::format("color/{:06}.jpg", i), 32, 24);
    WriteDepthPng(folder / fmt::format("depth/{:06}.png", i), 32, 24, 1000);
    WriteText(folder / fmt::format("pose/{:06}.txt", i),
              fmt::format("1 0 0 {}\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", 0.01 * i));
  }
  WriteText(folder / "intrinsics.json", kIntrinsics);
}

FindingHandler FailOnFinding() {
  return [](const CheckFinding& finding) { ADD_FAILURE() << finding.message; };
}

}  // namespace curvefusion
