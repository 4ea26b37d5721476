#include "meshing/tube_layout.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <utility>

#include "kernel/angle.h"
#include "kernel/parallel.h"
#include "meshing/hashed_number.h"
#include "meshing/rough_stretches.h"
#include "meshing/self_intersections.h"
#include "meshing/stubs.h"
#include "meshing/tube_network.h"
#include "meshing/tubes.h"

namespace curvefusion {

namespace {

constexpr double kMaxTurn = std::numbers::pi / 4;  // at a mitred ring
// Polygons of tubes that follow the shape of their curves have so many times more sides.
constexpr int kRoughSides = 2;
constexpr double kGentle = 2;  // strips are so many times longer than what would fold

// Rings of different tubes are turned against each other, so that their facets do not lie in one
// plane where the tubes meet.
double PhaseOf(double turn, int sides) { return 2 * std::numbers::pi / sides * turn; }

// A whole tube, and the segment of each of its triangles.
struct WholeTube {
  TriangleMesh mesh;
  std::vector<int> segment_of_face;

  WholeTube(const TubePath& path, const TubeRings& rings) : mesh{rings.vertices, {}} {
    for (int segment = 0; segment < path.segment_count(); ++segment) {
      const auto side = SegmentTriangles(rings, segment);
      mesh.triangles.insert(mesh.triangles.end(), side.begin(), side.end());
      segment_of_face.resize(mesh.triangles.size(), segment);
    }
  }
};

bool IsSound(const TubePath& path, const TubeRings& rings) {
  return FindSelfIntersections(WholeTube(path, rings).mesh, 1).empty();
}

// The point at which a path that intersects itself is best cut: the sharpest turn between the first
// two segments found to meet. Nothing where the tube is sound.
std::optional<int> CutAgainstSelfIntersection(const TubePath& path, const TubeRings& rings) {
  const WholeTube tube(path, rings);
  const auto hits = FindSelfIntersections(tube.mesh, 1);
  if (hits.empty()) return std::nullopt;
  const int n = static_cast<int>(path.axis.points.size());
  const int last_cut = path.closed ? n - 1 : n - 2;
  const int from = std::max(tube.segment_of_face[hits[0].first], path.closed ? 0 : 1);
  const int to = std::min(tube.segment_of_face[hits[0].second] + 1, last_cut);
  int best = -1;
  double sharpest = -1;
  for (int i = from; i <= to; ++i) {
    const Polyline& p = path.axis.points;
    const double turn = AngleBetween(p[i] - p[(i + n - 1) % n], p[(i + 1) % n] - p[i]);
    if (turn > sharpest) {
      sharpest = turn;
      best = i;
    }
  }
  if (best < 0) return std::nullopt;  // a single segment: the check of the result will tell
  return best;
}

// Whether all turns of a path are so gentle that no strip comes near folding. Such a tube is sound,
// as no part of it comes near another (CutSelfContacts).
bool IsGentle(const TubePath& path) {
  const Polyline& p = path.axis.points;
  const size_t n = p.size();
  double turn_before = path.closed ? AngleBetween(p[0] - p[n - 1], p[1] - p[0]) : 0;
  for (size_t i = 0; i < static_cast<size_t>(path.segment_count()); ++i) {
    const size_t next = (i + 1) % n;
    const bool turns = path.closed || next + 1 < n;
    const double turn = turns ? AngleBetween(p[next] - p[i], p[(next + 1) % n] - p[next]) : 0;
    const double radius = std::max(path.axis.radii[i], path.axis.radii[next]);
    if (StripFolds((p[next] - p[i]).norm() / kGentle, radius, std::max(turn_before, turn), turn)) {
      return false;
    }
    turn_before = turn;
  }
  return true;
}

// A tube with the shape of the balls along its curve where there are any, or of its axis only.
TubeRings Sweep(const TubePath& path, int sides, double turn, const std::vector<TubeAxis>& balls) {
  const bool is_rough =
      std::any_of(balls.begin(), balls.end(), [](const TubeAxis& b) { return !b.points.empty(); });
  const int count = is_rough ? kRoughSides * sides : sides;
  return SweepRings(path, count, PhaseOf(turn, count), balls);
}

// Sweeps all paths; those that intersect themselves are cut until none does.
void SweepSoundly(int sides, uint64_t seed, const std::vector<TubeAxis>& curves,
                  TubeLayout& layout) {
  for (bool all_sound = false; !all_sound;) {
    std::vector<std::optional<int>> cuts(layout.paths.size());
    const std::vector<std::vector<TubeAxis>> balls = FindRoughStretches(layout.paths, curves);
    layout.rings.resize(layout.paths.size());
    ParallelFor(0, static_cast<int64_t>(layout.paths.size()), 1, [&](int64_t i) {
      const TubePath& path = layout.paths[i];
      const double turn = HashedNumber((seed << 32) + static_cast<uint64_t>(i));
      layout.rings[i] = Sweep(path, sides, turn, balls[i]);
      if (layout.rings[i].sides > sides) {
        if (IsSound(path, layout.rings[i])) return;
        layout.rings[i] = Sweep(path, sides, turn, {});
      }
      if (!IsGentle(path)) cuts[i] = CutAgainstSelfIntersection(path, layout.rings[i]);
    });
    all_sound = std::none_of(cuts.begin(), cuts.end(), [](const auto& cut) { return cut; });
    if (all_sound) continue;
    std::vector<TubePath> pieces;
    for (size_t i = 0; i < cuts.size(); ++i) {
      if (!cuts[i]) {
        pieces.push_back(std::move(layout.paths[i]));
        continue;
      }
      for (TubePath& piece : CutPath(layout.paths[i], *cuts[i])) pieces.push_back(std::move(piece));
    }
    layout.paths = CutSelfContacts(std::move(pieces));
  }
}

}  // namespace

TubeLayout LayOutTubes(const SkeletonGraph& graph, const TubeOptions& options, uint64_t seed) {
  TubeLayout layout;
  AxisOptions axis;
  axis.tolerance = options.axis_tolerance;
  axis.max_turn = kMaxTurn;
  const TubeNetwork network = PrepareTubes(graph, options.default_radius, axis);
  layout.paths = CutSelfContacts(ChainTubes(network, kMaxTurn, options.ring_spacing));
  SweepSoundly(options.sides, seed, network.curves, layout);
  layout.groups = GroupContacts(layout.paths);
  return layout;
}

}  // namespace curvefusion
