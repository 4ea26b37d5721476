#include "capture/content/depth_edges.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "kernel/thinned.h"

namespace curvefusion {

namespace {

constexpr float kMaxDepth = 3.5f;  // metres; chosen: farther off depth edges are blurred by noise
constexpr float kMinStep = 0.03f;  // metres; chosen: ten times a Kinect's noise at 1.5 m
constexpr float kMinStepShare = 0.04f;  // of the depth; chosen: the same at larger distances
// Pixels of a 640 px wide image. Derived: the shadow of a baseline of 75 mm and f 580 behind an
// edge at 0.7 m before a background at 1.1 m is 23 px wide.
constexpr int kMaxGap = 24;
constexpr int kBorder = 4;        // px; no discontinuity is seen whole there
constexpr int kMinPiece = 15;     // px of a 640 px wide image; measured: drops specks, keeps wires
constexpr int kNormalRadius = 4;  // px; steps of a digital line are shorter
constexpr int kReferenceWidth = 640;

enum EdgeBits : uint8_t { kRight = 1, kLeft = 2, kBelow = 4, kAbove = 8 };

int ForWidth(int pixels, int width) { return std::max(1, pixels * width / kReferenceWidth); }

// Marks the near sides along one line of pixels. `at(i)` is the depth, `mark(i, before)` a call for
// each near side; `before` tells that the deeper pixel comes first.
template <class At, class Mark>
void ScanLine(int count, int max_gap, const At& at, const Mark& mark) {
  int last = -1;
  for (int i = 0; i < count; ++i) {
    const float depth = at(i);
    if (depth <= 0) continue;
    if (last >= 0 && i - last <= max_gap) {
      const float before = at(last);
      const float near = std::min(depth, before);
      if (std::abs(depth - before) > std::max(kMinStep, kMinStepShare * near)) {
        if (depth < before) {
          mark(i, true);
        } else {
          mark(last, false);
        }
      }
    }
    last = i;
  }
}

Image<uint8_t> MarkNearSides(const DepthImage& depth) {
  Image<uint8_t> edges(depth.width(), depth.height(), 0);
  const int max_gap = ForWidth(kMaxGap, depth.width());
  for (int v = 0; v < depth.height(); ++v) {
    ScanLine(
        depth.width(), max_gap, [&](int u) { return depth(u, v); },
        [&](int u, bool before) { edges(u, v) |= before ? kLeft : kRight; });
  }
  // Column by column would miss the cache: all columns go down together.
  std::vector<int> last(static_cast<size_t>(depth.width()), -1);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      const float here = depth(u, v);
      if (here <= 0) continue;
      const int above = std::exchange(last[static_cast<size_t>(u)], v);
      if (above < 0 || v - above > max_gap) continue;
      const float before = depth(u, above);
      if (std::abs(here - before) <= std::max(kMinStep, kMinStepShare * std::min(here, before))) {
        continue;
      }
      if (here < before) {
        edges(u, v) |= kAbove;
      } else {
        edges(u, above) |= kBelow;
      }
    }
  }
  return edges;
}

// Clears 8-connected pieces of fewer pixels.
void DropSmallPieces(int min_pixels, Image<uint8_t>& edges) {
  Image<uint8_t> is_seen(edges.width(), edges.height(), 0);
  std::vector<std::pair<int, int>> piece;
  for (int v = 0; v < edges.height(); ++v) {
    for (int u = 0; u < edges.width(); ++u) {
      if (edges(u, v) == 0 || is_seen(u, v) != 0) continue;
      piece.assign(1, {u, v});
      is_seen(u, v) = 1;
      for (size_t i = 0; i < piece.size(); ++i) {
        const auto [pu, pv] = piece[i];
        for (int dv = -1; dv <= 1; ++dv) {
          for (int du = -1; du <= 1; ++du) {
            if (!edges.Contains(pu + du, pv + dv) || edges(pu + du, pv + dv) == 0 ||
                is_seen(pu + du, pv + dv) != 0) {
              continue;
            }
            is_seen(pu + du, pv + dv) = 1;
            piece.emplace_back(pu + du, pv + dv);
          }
        }
      }
      if (static_cast<int>(piece.size()) >= min_pixels) continue;
      for (const auto& [pu, pv] : piece) edges(pu, pv) = 0;
    }
  }
}

// The mean direction to deeper pixels nearby.
float NormalAngle(const Image<uint8_t>& edges, int u, int v) {
  int x = 0, y = 0;
  for (int dv = -kNormalRadius; dv <= kNormalRadius; ++dv) {
    for (int du = -kNormalRadius; du <= kNormalRadius; ++du) {
      if (!edges.Contains(u + du, v + dv)) continue;
      const uint8_t bits = edges(u + du, v + dv);
      x += ((bits & kRight) != 0) - ((bits & kLeft) != 0);
      y += ((bits & kBelow) != 0) - ((bits & kAbove) != 0);
    }
  }
  const double angle = std::atan2(y, x);
  return static_cast<float>(angle < 0 ? angle + std::numbers::pi : angle);
}

}  // namespace

std::vector<DepthEdgePoint> FindDepthEdges(const DepthImage& depth, int max_points) {
  Image<uint8_t> edges = MarkNearSides(depth);
  DropSmallPieces(ForWidth(kMinPiece, depth.width()), edges);
  std::vector<DepthEdgePoint> all;
  for (int v = kBorder; v < depth.height() - kBorder; ++v) {
    for (int u = kBorder; u < depth.width() - kBorder; ++u) {
      if (edges(u, v) != 0 && depth(u, v) < kMaxDepth) all.push_back({u, v, depth(u, v), 0});
    }
  }
  std::vector<DepthEdgePoint> picked = ThinnedTo(all, static_cast<size_t>(max_points));
  for (DepthEdgePoint& point : picked) point.angle = NormalAngle(edges, point.u, point.v);
  return picked;
}

}  // namespace curvefusion
