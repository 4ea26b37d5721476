#include "fusion/nets/net_wires.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "capture/frame_stream.h"
#include "fusion/nets/box_sums.h"
#include "fusion/nets/surface_views.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Chosen: few frames and pixels, as every scan is looked at for nets.
constexpr int kFrames = 6;          // looked at: of a scan to find nets, of a bundle to find wires
constexpr int kCoarse = 2;          // pixels that are one where nets are looked for
constexpr int kMinFrames = 2;       // of the scan that must show a net in a cell
constexpr double kPixelsOff = 0.2;  // by which images remain displaced after they were aligned
// The next ones were chosen on the training scans of docs/nets.md, rooms among them.
// Change over what noise and displacement give.
constexpr float kGap = 1.4f;       // above: the images show different things
constexpr double kClearly = 3;     // and above, without displacement: brightness differs by less
constexpr float kWire = 0.6f;      // below this share of the mean around: they show the same
constexpr double kGrown = 2;       // above, without displacement: part of a net if beside one
constexpr double kAround = 0.006;  // metres to each side: half of the widest gaps that depth closes
constexpr double kPatch = 0.01;    // metres to each side: a patch that holds several gaps and wires
constexpr float kMinGaps = 0.1f;   // of each quarter of a patch of a net
constexpr float kMinWires = 0.1f;  // of the patch
constexpr float kStep = 0.015f;    // metres from pixel to pixel: that of OpenDepth
constexpr float kMinPatches = 0.5f;  // of what is twice as wide

int Pixels(const SurfaceViews& surface, int u, int v, double length) {
  return std::max(1,
                  static_cast<int>(std::lround(length * surface.camera.fx / surface.depth(u, v))));
}

// Of every pixel whether images show different things there, the same, or neither.
struct Parts {
  Image<float> gaps;   // 0 or 1; -1 = not known
  Image<float> wires;  // likewise
  MaskImage above;     // 1 where images differ by more than around
};

Parts PartsOf(const SurfaceViews& surface, double noise) {
  const int width = surface.depth.width(), height = surface.depth.height();
  Image<float> ratio(width, height, -1);
  for (size_t i = 0; i < ratio.size(); ++i) {
    if (surface.change.data()[i] < 0) continue;
    const double expected = noise + kPixelsOff * surface.slope.data()[i];
    ratio.data()[i] = static_cast<float>(surface.change.data()[i] / expected);
  }
  Parts parts{Image<float>(width, height, -1), Image<float>(width, height, -1),
              MaskImage(width, height, 0)};
  const BoxSums sums(ratio);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      if (ratio(u, v) < 0) continue;
      parts.gaps(u, v) = ratio(u, v) > kGap && surface.change(u, v) > kClearly * noise;
      const float around = sums.Mean(u, v, Pixels(surface, u, v, kAround));
      parts.wires(u, v) = ratio(u, v) < kWire * around;
      parts.above(u, v) = ratio(u, v) > around;
    }
  }
  return parts;
}

// The least share of a patch's quarters: what lies along an outline is in some of them only.
float LeastQuarter(const BoxSums& shares, int u, int v, int reach) {
  const int half = std::max(1, reach / 2);
  float least = 1;
  for (const int dv : {-half, half})
    for (const int du : {-half, half}) least = std::min(least, shares.Mean(u + du, v + dv, half));
  return least;
}

// 1 at the pixels with gaps and wires all around, most of them wherever one looks within 20 mm:
// what lies along outlines is narrower. Nothing where that is less than a few square centimetres.
MaskImage PatchesOfNets(const SurfaceViews& surface, const Parts& parts) {
  const int width = surface.depth.width(), height = surface.depth.height();
  const BoxSums gaps(parts.gaps), wires(parts.wires);
  Image<float> patches(width, height, 0);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      if (surface.change(u, v) < 0) continue;
      const int reach = Pixels(surface, u, v, kPatch);
      if (LeastQuarter(gaps, u, v, reach) < kMinGaps || wires.Mean(u, v, reach) < kMinWires)
        continue;
      patches(u, v) = 1;
    }
  }
  const BoxSums shares(patches);
  MaskImage net(width, height, 0);
  double area = 0;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      if (!(patches(u, v) > 0) ||
          shares.Mean(u, v, 2 * Pixels(surface, u, v, kPatch)) < kMinPatches) {
        continue;
      }
      net(u, v) = 1;
      const double side = surface.depth(u, v) / surface.camera.fx;
      area += side * side;
    }
  }
  return area < Nets::kMinArea ? MaskImage(width, height, 0) : net;
}

using Pixel = std::pair<int, int>;

// The pixels that hang together with a first one on one surface, as far as `may` allows; taken out
// of `may`.
std::vector<Pixel> TakePart(Pixel first, const DepthImage& depth, MaskImage& may) {
  std::vector<Pixel> part = {first};
  may(first.first, first.second) = 0;
  for (size_t i = 0; i < part.size(); ++i) {
    const auto [u, v] = part[i];
    for (const auto& [du, dv] : kPixelsBeside) {
      if (!may.Contains(u + du, v + dv) || !may(u + du, v + dv) ||
          std::abs(depth(u + du, v + dv) - depth(u, v)) > kStep) {
        continue;
      }
      may(u + du, v + dv) = 0;
      part.emplace_back(u + du, v + dv);
    }
  }
  return part;
}

// The patches and what hangs together with them where images change, be it by displacement.
MaskImage NetPixels(const MaskImage& patches, const SurfaceViews& surface, double noise) {
  const BoxSums change(surface.change);
  MaskImage may = patches, net(patches.width(), patches.height(), 0);
  for (int v = 0; v < may.height(); ++v) {
    for (int u = 0; u < may.width(); ++u) {
      if (surface.change(u, v) < 0) continue;
      may(u, v) |= change.Mean(u, v, Pixels(surface, u, v, kPatch)) > kGrown * noise;
    }
  }
  for (int v = 0; v < may.height(); ++v) {
    for (int u = 0; u < may.width(); ++u) {
      if (!patches(u, v) || !may(u, v)) continue;
      for (const auto& [x, y] : TakePart({u, v}, surface.depth, may)) net(x, y) = 1;
    }
  }
  return net;
}

// Metres from where change rises above its mean around to where it does again, along a row or
// column of a net that starts at a pixel.
void AddPeriods(const SurfaceViews& surface, const MaskImage& net, const MaskImage& above,
                Pixel start, const Pixel& step, std::vector<double>& periods) {
  double length = -1;  // since it last rose; negative: not yet
  auto& [u, v] = start;
  for (int du = step.first, dv = step.second; net.Contains(u + du, v + dv); u += du, v += dv) {
    if (!net(u, v) || !net(u + du, v + dv)) {
      length = -1;
      continue;
    }
    if (length >= 0) length += surface.depth(u, v) / surface.camera.fx;
    if (!above(u, v) && above(u + du, v + dv)) {
      if (length > 0) periods.push_back(length);
      length = 0;
    }
  }
}

// From wire to wire, metres: along rows or columns, whichever cross more wires.
double SpacingIn(const SurfaceViews& surface, const MaskImage& net, const MaskImage& above) {
  std::vector<double> along_rows, along_columns;
  for (int v = 0; v < net.height(); ++v)
    AddPeriods(surface, net, above, {0, v}, {1, 0}, along_rows);
  for (int u = 0; u < net.width(); ++u)
    AddPeriods(surface, net, above, {u, 0}, {0, 1}, along_columns);
  const std::vector<double>& most =
      along_rows.size() > along_columns.size() ? along_rows : along_columns;
  return most.empty() ? 0 : Median(most);
}

// In how many frames a cell was looked at, and in how many of them it is part of a net.
struct CellCounts {
  int seen = 0;
  int net = 0;
};
using CellMap = std::map<VoxelKey, CellCounts>;

void CountCells(const SurfaceViews& surface, const MaskImage& net, CellMap& counts) {
  std::set<VoxelKey> seen, in_net;
  for (int v = 0; v < net.height(); ++v) {
    for (int u = 0; u < net.width(); ++u) {
      if (surface.change(u, v) < 0) continue;
      const Vec3 p = surface.camera.Unproject(u, v, surface.depth(u, v));
      const VoxelKey cell = VoxelOf(surface.T_world_camera * p, Nets::kCell);
      (net(u, v) ? in_net : seen).insert(cell);
    }
  }
  for (const VoxelKey& cell : in_net) ++counts[cell].net;
  seen.merge(in_net);
  for (const VoxelKey& cell : seen) ++counts[cell].seen;
}

// Ascending.
std::vector<VoxelKey> WithThoseBeside(const std::vector<VoxelKey>& cells) {
  std::set<VoxelKey> all;
  for (const VoxelKey& cell : cells)
    for (int i = 0; i < 27; ++i)
      all.insert({cell.x + i % 3 - 1, cell.y + i / 3 % 3 - 1, cell.z + i / 9 - 1});
  return {all.begin(), all.end()};
}

// Where at least so many of the frames, and most of those that look there, show a net. What is
// behind thin wires looks like one only from where these hide it.
Nets NetsIn(const std::vector<SurfaceViews>& surfaces, int min_frames) {
  std::vector<double> noise, spacings;
  for (const SurfaceViews& surface : surfaces)
    if (!surface.change.empty()) noise.push_back(surface.noise);
  Nets nets;
  if (noise.empty()) return nets;
  nets.noise = Median(noise);
  CellMap counts;
  for (const SurfaceViews& surface : surfaces) {
    if (surface.change.empty()) continue;
    const Parts parts = PartsOf(surface, nets.noise);
    const MaskImage patches = PatchesOfNets(surface, parts);
    if (AnySet(patches)) spacings.push_back(SpacingIn(surface, patches, parts.above));
    CountCells(surface, NetPixels(patches, surface, nets.noise), counts);
  }
  std::vector<VoxelKey> cells;
  for (const auto& [cell, frames] : counts)
    if (frames.net >= min_frames && 2 * frames.net > frames.seen) cells.push_back(cell);
  if (static_cast<double>(cells.size()) * Nets::kCell * Nets::kCell < Nets::kMinArea) return nets;
  nets.cells = WithThoseBeside(cells);
  nets.spacing = Median(spacings);
  return nets;
}

}  // namespace

bool Nets::Contains(const Vec3& p_world) const {
  return std::binary_search(cells.begin(), cells.end(), VoxelOf(p_world, kCell));
}

Nets FindNets(const Sequence& sequence) {
  const std::vector<int> frames = EvenlyThinned(AllFrames(sequence), kFrames);
  std::vector<SurfaceViews> surfaces;
  Nets nets;
  // Most scans show no net in the first half of these frames.
  for (const size_t first : {0, 1}) {
    for (size_t i = first; i < frames.size(); i += 2) {
      surfaces.push_back(LookAtSurface(sequence, frames[i],
                                       sequence.frames[frames[i]].T_world_camera, {kCoarse, {}}));
    }
    nets = NetsIn(surfaces, first == 0 ? 1 : kMinFrames);
    if (nets.empty()) break;
  }
  return nets;
}

std::vector<NetWires> FindNetWires(const Sequence& sequence, int first, int last,
                                   const Nets& nets) {
  std::vector<NetWires> found;
  std::vector<int> frames(last - first);
  std::iota(frames.begin(), frames.end(), first);
  int earlier = first;
  RigidTransform T_world_camera = sequence.frames[first].T_world_camera;
  for (const int frame : EvenlyThinned(frames, kFrames)) {
    if (frame != earlier) T_world_camera = PoseAfter(sequence, earlier, T_world_camera, frame);
    earlier = frame;
    const SurfaceViews surface = LookAtSurface(
        sequence, frame, T_world_camera, {1, [&](const Vec3& p) { return nets.Contains(p); }});
    if (surface.change.empty()) continue;
    const Parts parts = PartsOf(surface, nets.noise);
    NetWires wires{frame, T_world_camera,
                   MaskImage(surface.depth.width(), surface.depth.height(), 0), surface.depth};
    for (size_t i = 0; i < wires.mask.size(); ++i) wires.mask.data()[i] = parts.wires.data()[i] > 0;
    found.push_back(std::move(wires));
  }
  return found;
}

}  // namespace curvefusion
