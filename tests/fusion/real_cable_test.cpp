// The real cable scan, judged in its own colour images: the cable is the dark thing that enters
// from the left in the upper left part of nearly every image, alone there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "fusion/pipeline.h"
#include "tests/test_data.h"

namespace curvefusion {
namespace {

constexpr int kRight = 560;  // pixels; the part of the image where the cable hangs
constexpr int kBottom = 300;
constexpr uint8_t kDark = 75;  // the cable's brightest channel is below, wood and floor above
constexpr int kMinColumns = 120;

bool IsDark(const Rgb& pixel) { return std::max({pixel[0], pixel[1], pixel[2]}) < kDark; }

// Dark pixels connected to the left border within the part that is looked at.
MaskImage CableMask(const ColorImage& image) {
  MaskImage mask(kRight, kBottom, 0);
  std::vector<std::pair<int, int>> frontier;
  const auto visit = [&](int u, int v) {
    if (!mask.Contains(u, v) || mask(u, v) || !IsDark(image(u, v))) return;
    mask(u, v) = 1;
    frontier.emplace_back(u, v);
  };
  for (int v = 0; v < kBottom; ++v) visit(0, v);
  while (!frontier.empty()) {
    const auto [u, v] = frontier.back();
    frontier.pop_back();
    visit(u + 1, v);
    visit(u - 1, v);
    visit(u, v + 1);
    visit(u, v - 1);
  }
  return mask;
}

// Centres of the cable in the columns where some of its pixels have depth.
std::vector<Vec2> ColumnsWithDepth(const MaskImage& mask, const DepthImage& depth) {
  std::vector<Vec2> centres;
  int columns = 0;
  for (int u = 0; u < mask.width(); ++u) {
    double sum = 0;
    int count = 0, measured = 0;
    for (int v = 0; v < mask.height(); ++v) {
      if (!mask(u, v)) continue;
      sum += v;
      ++count;
      measured += depth(u, v) > 0;
    }
    columns += count > 0;
    if (measured > 0) centres.emplace_back(u, sum / count);
  }
  if (columns < kMinColumns) centres.clear();  // the cable enters farther below
  return centres;
}

double DistanceTo(const MaskImage& mask, const Vec2& pixel, int reach) {
  double nearest = reach + 1;
  const int u = static_cast<int>(std::lround(pixel.x())),
            v = static_cast<int>(std::lround(pixel.y()));
  for (int y = v - reach; y <= v + reach; ++y) {
    for (int x = u - reach; x <= u + reach; ++x) {
      if (mask.Contains(x, y) && mask(x, y))
        nearest = std::min(nearest, (Vec2(x, y) - pixel).norm());
    }
  }
  return nearest;
}

// Pixels of the curves in one image, every half millimetre, within the part that is looked at.
std::vector<Vec2> ProjectedCurves(const SkeletonGraph& skeleton, const PinholeCamera& camera,
                                  const RigidTransform& T_camera_world) {
  std::vector<Vec2> pixels;
  for (const EdgeId id : skeleton.Edges()) {
    for (const Vec3& p : Resample(skeleton.edge(id).points, 0.5 * kMillimetre)) {
      const Vec3 p_camera = T_camera_world * p;
      if (p_camera.z() <= 0) continue;
      const Vec2 pixel = camera.Project(p_camera);
      if (pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < kRight && pixel.y() < kBottom) {
        pixels.push_back(pixel);
      }
    }
  }
  return pixels;
}

TEST(RealCable, TheCurveLiesOnTheCableInTheImages) {
  const auto folder = SharedData("real/cable_d435i");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  const Sequence sequence = OpenSequence(folder);
  PipelineObserver silent;
  const Reconstruction result = Reconstruct(sequence, ProfileOptions(Profile::kBest), silent);
  const Sequence& corrected = result.sequence;
  double frames = 0, columns = 0, covered = 0, pixels = 0, on_cable = 0;
  for (int i = 0; i < corrected.frame_count(); ++i) {
    const MaskImage mask = CableMask(LoadColor(corrected, i));
    const std::vector<Vec2> centres = ColumnsWithDepth(mask, LoadDepth(corrected, i));
    if (centres.empty()) continue;
    frames += 1;
    const std::vector<Vec2> curve =
        ProjectedCurves(result.skeleton, corrected.color_camera,
                        corrected.T_color_depth * corrected.frames[i].T_world_camera.inverse());
    for (const Vec2& centre : centres) {
      columns += 1;
      covered += std::any_of(curve.begin(), curve.end(),
                             [&](const Vec2& pixel) { return (pixel - centre).norm() <= 12; });
    }
    for (const Vec2& pixel : curve) {
      pixels += 1;
      on_cable += DistanceTo(mask, pixel, 8) <= 8;
    }
  }
  std::cout << frames << " frames show the cable; columns with depth covered within 12 px: "
            << covered / columns << ", curve on the cable within 8 px: " << on_cable / pixels
            << "\n";
  EXPECT_GE(frames, 40);
  EXPECT_GE(covered / columns, 0.95);
  EXPECT_GE(on_cable / pixels, 0.98);
}

}  // namespace
}  // namespace curvefusion
