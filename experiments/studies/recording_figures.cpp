#include "experiments/studies/recording_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "capture/content/colour_camera.h"
#include "capture/content/depth_agreement.h"
#include "experiments/simulation/small_components.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

using Figures = std::map<std::string, double>;

constexpr int kDepthFrames = 12;
constexpr double kFarthest = 8;  // metres; what lies beyond is a marker of "nothing", as 65.535 m

DepthImage Depth(const Sequence& sequence, int frame) {
  DepthImage depth = LoadDepth(sequence, frame);
  for (size_t i = 0; i < depth.size(); ++i) {
    if (!(depth.data()[i] < kFarthest)) depth.data()[i] = 0;
  }
  return depth;
}

struct Specks {
  double measured = 0;
  double small = 0;
  double front = 0;
  double components_6_20 = 0;
  double components_21_160 = 0;
};

// Whether no surface of any size within 15x15 pixels is as near as 30 mm behind a pixel.
bool IsInFront(const DepthImage& depth, const Image<int>& sizes, int u, int v) {
  constexpr int kReach = 7;
  constexpr int kSurface = 200;
  double nearest = std::numeric_limits<double>::infinity();
  for (int y = std::max(v - kReach, 0); y <= std::min(v + kReach, depth.height() - 1); ++y) {
    for (int x = std::max(u - kReach, 0); x <= std::min(u + kReach, depth.width() - 1); ++x) {
      if (sizes(x, y) > kSurface) nearest = std::min(nearest, static_cast<double>(depth(x, y)));
    }
  }
  return std::isfinite(nearest) && depth(u, v) < nearest - 0.03;
}

Specks SpecksOf(const DepthImage& depth) {
  const Image<int> sizes = ComponentSizes(depth, {.step = 0.004, .slope = 0.02});
  Specks specks;
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      const int size = sizes(u, v);
      if (size == 0) continue;
      specks.measured += 1.0 / static_cast<double>(depth.size());
      if (size > 5 && size <= 20) specks.components_6_20 += 1.0 / size;
      if (size > 20 && size <= 160) specks.components_21_160 += 1.0 / size;
      if (size > 20) continue;
      ++specks.small;
      specks.front += IsInFront(depth, sizes, u, v);
    }
  }
  return specks;
}

struct Shadows {
  int left = 0;
  int right = 0;
  std::vector<double> widths;  // over the expected ones
};

// Of a gap in a row between two measured pixels.
void AddGap(int width, float depth_left, float depth_right, double focal_length, Shadows& shadows) {
  constexpr double kBaseline = 0.075;
  constexpr double kLeastShadow = 5;
  const double expected = focal_length * kBaseline * std::abs(1.0 / depth_left - 1.0 / depth_right);
  if (width < 3 || width > 100 || expected < kLeastShadow) return;
  if (depth_right > depth_left) {
    ++shadows.right;
    return;
  }
  ++shadows.left;
  shadows.widths.push_back(width / expected);
}

void AddShadows(const DepthImage& depth, double focal_length, Shadows& shadows) {
  constexpr int kRowStep = 4;
  for (int v = 0; v < depth.height(); v += kRowStep) {
    int last = -1;
    for (int u = 0; u < depth.width(); ++u) {
      if (!(depth(u, v) > 0)) continue;
      if (last >= 0) {
        AddGap(u - last - 1, depth(last, v), depth(u, v), focal_length, shadows);
      }
      last = u;
    }
  }
}

std::vector<int> SpreadFrames(int frame_count, int most) {
  const int count = std::min(frame_count, most);
  std::vector<int> frames;
  for (int i = 0; i < count; ++i) frames.push_back(i * frame_count / count);
  return frames;
}

struct DistanceBand {
  const char* name;
  float least;
  float greatest;
};
constexpr std::array<DistanceBand, 4> kBands = {
    {{"0.8", 0.6F, 1.0F}, {"1.2", 1.0F, 1.4F}, {"1.6", 1.4F, 1.8F}, {"2.5", 2.2F, 2.8F}}};

class Disagreement {
 public:
  Disagreement(const Sequence& sequence, std::vector<FramePair> pairs)
      : pairs_(std::move(pairs)),
        views_(DepthThumbnails(sequence, FramesOf(pairs_)), sequence.depth_scale) {}

  void Add(const std::vector<RigidTransform>& poses) {
    for (const FramePair& pair : pairs_) {
      if (!views_.Has(pair.from) || !views_.Has(pair.to)) continue;
      int samples = 0;
      const RigidTransform T_to_from =
          poses[static_cast<size_t>(pair.to)].inverse() * poses[static_cast<size_t>(pair.from)];
      for (const auto& overlap : views_.Overlaps(pair.from, pair.to, T_to_from, samples)) {
        for (size_t i = 0; i < kBands.size(); ++i) {
          const bool inside =
              overlap.distance >= kBands[i].least && overlap.distance < kBands[i].greatest;
          if (inside) differences_[i].push_back(std::abs(overlap.difference));
        }
      }
    }
  }

  Figures Medians_mm() const {
    constexpr size_t kFewest = 500;  // chosen: fewer points are one corner of one thing
    Figures figures;
    for (size_t i = 0; i < kBands.size(); ++i) {
      if (differences_[i].size() < kFewest) continue;
      figures[fmt::format("disagree_{}", kBands[i].name)] = Median(differences_[i]) / kMillimetre;
    }
    return figures;
  }

 private:
  std::vector<FramePair> pairs_;
  DepthViews views_;
  std::array<std::vector<double>, kBands.size()> differences_;
};

std::vector<FramePair> PairsOf(int frame_count) {
  constexpr int kGap = 30;
  constexpr int kPairs = 40;
  std::vector<FramePair> pairs;
  for (const int from : SpreadFrames(std::max(frame_count - kGap, 0), kPairs)) {
    pairs.push_back({from, from + kGap});
  }
  return pairs;
}

}  // namespace

Figures DepthFigures(const Sequence& sequence) {
  std::vector<double> measured;
  std::vector<double> small;
  std::vector<double> front;
  Shadows shadows;
  Figures figures;
  const std::vector<int> frames = SpreadFrames(sequence.frame_count(), kDepthFrames);
  for (const int frame : frames) {
    const DepthImage depth = Depth(sequence, frame);
    const Specks specks = SpecksOf(depth);
    measured.push_back(specks.measured);
    small.push_back(specks.small);
    front.push_back(specks.front);
    const double share = 1.0 / static_cast<double>(frames.size());
    figures["components_6_20"] += share * specks.components_6_20;
    figures["components_21_160"] += share * specks.components_21_160;
    AddShadows(depth, sequence.depth_camera.fx, shadows);
  }
  if (frames.empty()) return figures;
  figures["measured"] = Median(std::move(measured));
  figures["small"] = Median(std::move(small));
  figures["front"] = Median(std::move(front));
  if (shadows.left == 0) return figures;
  figures["shadow_left"] = static_cast<double>(shadows.left) / (shadows.left + shadows.right);
  figures["shadow_width"] = Median(std::move(shadows.widths));
  return figures;
}

Figures DisagreementFigures(const Sequence& sequence, const PoseErrorModel* errors, uint64_t seed) {
  constexpr uint64_t kDraws = 20;
  const std::vector<RigidTransform> poses = CameraPoses(sequence);
  Disagreement disagreement(sequence, PairsOf(sequence.frame_count()));
  if (errors == nullptr) disagreement.Add(poses);
  for (uint64_t draw = 0; errors != nullptr && draw < kDraws; ++draw) {
    disagreement.Add(DriftedPoses(poses, 30, *errors, 1000 * seed + draw));
  }
  return disagreement.Medians_mm();
}

Figures ColorFigures(const Sequence& sequence) {
  const ColourCameraFit fit = FitColourCamera(sequence, {});
  if (!fit.measured) return {};
  return {{"color_offset_px", fit.displacement_px}};
}

}  // namespace curvefusion
