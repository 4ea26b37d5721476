#include "fusion/silhouettes/weak_wires.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "fusion/silhouettes/silhouette_path.h"
#include "graph/junctions.h"
#include "graph/sampled_curves.h"
#include "kernel/dbscan.h"
#include "kernel/parallel.h"
#include "kernel/point_grid.h"
#include "kernel/quantile.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

namespace {

constexpr double kStep = 0.002;          // metres; along ways, and of the grid of points
constexpr double kCurveStep = 0.004;     // metres; between places at which paths may end
constexpr double kBeside = 0.0075;       // metres; points of a curve lie nearer to it
constexpr double kLink = 0.006;          // metres; between the points of a piece
constexpr int kCorePoints = 3;           // of a piece
constexpr double kOnPath = 0.0035;       // metres; from a path to points of its wire
constexpr double kMiss = 0.004;          // metres; at which a path still meets a curve
constexpr double kSnapDistance = 0.006;  // metres; paths end at nodes this near
constexpr double kEndReach = 0.008;      // metres; so near to its ends a path lies beside curves
constexpr double kClearance = 0.005;     // metres; of a path inside
constexpr double kFar = 0.0125;          // metres; of some place of a path
constexpr int kMinSteps = 4;             // of a path that have points
// Of the images: true wires are seen beside all curves in .18 to .60 of them somewhere on their
// path (training seeds), false ones, which lie before or behind a curve or a net, in .12 at most.
constexpr double kMinBeside = 0.15;
// Radians. From nearly one side what images show as wire is far deeper than a wire is thick:
// without this limit six scans within .15 get 52 paths, most of them false, a chair within .28 and
// a rack within .35 one false path each, and a cat within just that two true ones.
constexpr double kMinParallax = 0.38;
constexpr double kAllAround = 0.02;  // metres; nearer curves may be met in any direction
constexpr int64_t kPlacesPerChunk = 1024;

std::vector<Vec3> BesideCurves(const std::vector<Vec3>& places, const PointGrid& curves) {
  std::vector<char> is_beside(places.size());
  ParallelFor(0, static_cast<int64_t>(places.size()), kPlacesPerChunk,
              [&](int64_t i) { is_beside[i] = curves.Nearest(places[i], kBeside) < 0; });
  std::vector<Vec3> beside;
  for (size_t i = 0; i < places.size(); ++i)
    if (is_beside[i]) beside.push_back(places[i]);
  return beside;
}

std::vector<Vec3> SeenAsWire(const std::vector<Vec3>& places, const WireSilhouettes& silhouettes,
                             double min_share) {
  const std::vector<double> shares = silhouettes.SharesAlong(places);
  std::vector<Vec3> wire;
  for (size_t i = 0; i < places.size(); ++i)
    if (shares[i] >= min_share) wire.push_back(places[i]);
  return wire;
}

// The middles of what hangs together, the largest first.
std::vector<Vec3> MiddlesOfPieces(const std::vector<Vec3>& places) {
  struct Piece {
    Vec3 sum = Vec3::Zero();
    int count = 0;
  };
  std::vector<Piece> pieces;
  const std::vector<int> labels = Dbscan(places, kLink, kCorePoints);
  for (size_t i = 0; i < places.size(); ++i) {
    if (labels[i] == kNoise) continue;
    pieces.resize(std::max(pieces.size(), static_cast<size_t>(labels[i]) + 1));
    pieces[labels[i]].sum += places[i];
    ++pieces[labels[i]].count;
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.count > b.count; });
  std::vector<Vec3> middles;
  for (const Piece& piece : pieces) middles.push_back(piece.sum / piece.count);
  return middles;
}

// The samples of curves around a place, by the directions in which they lie: for very many paths
// out of it.
class CurvesAround {
 public:
  CurvesAround(const PointGrid& curves, const Vec3& place, double reach) {
    curves.ForEachWithin(place, reach, [&](int sample, const Vec3& p) {
      samples_.push_back({sample, p - place});
    });
    const auto far = std::partition(samples_.begin(), samples_.end(), [](const Sample& sample) {
      return sample.offset.norm() < kAllAround;
    });
    near_count_ = static_cast<int>(far - samples_.begin());
    std::vector<Vec3> directions;
    for (auto sample = far; sample != samples_.end(); ++sample)
      directions.push_back(sample->offset.normalized());
    far_.emplace(directions, kMiss / kAllAround);
  }

  // The first sample that a path comes to within a length, looked for at every kStep of it, and the
  // nearest of several; -1 where there is none.
  int Met(const Vec3& direction, double length) const {
    Meeting first{.step = std::floor(length / kStep)};
    for (int i = 0; i < near_count_; ++i) Meet(samples_[i], direction, first);
    // An angle of that sine has a chord a little longer than its sine.
    far_->ForEachWithin(direction, 1.01 * kMiss / kAllAround, [&](int i, const Vec3&) {
      Meet(samples_[near_count_ + i], direction, first);
    });
    return first.sample;
  }

 private:
  struct Sample {
    int index;
    Vec3 offset;
  };
  struct Meeting {
    double step;
    double squared_distance = std::numeric_limits<double>::infinity();
    int sample = -1;
  };

  static void Meet(const Sample& sample, const Vec3& direction, Meeting& first) {
    const double along = sample.offset.dot(direction);
    const double squared_half =
        kMiss * kMiss - (sample.offset.squaredNorm() - along * along);  // of the path within kMiss
    if (squared_half < 0) return;
    const double half = std::sqrt(squared_half);
    const double step = std::max(1.0, std::ceil((along - half) / kStep));
    if (step > first.step || step * kStep > along + half) return;
    const double squared_distance = (step * kStep * direction - sample.offset).squaredNorm();
    if (step == first.step && squared_distance >= first.squared_distance) return;
    first = {step, squared_distance, sample.index};
  }

  std::vector<Sample> samples_;  // those that are near first
  int near_count_ = 0;
  std::optional<PointGrid> far_;  // directions of the others
};

// A straight path from one curve to another.
struct Chord {
  int front = -1;  // samples of curves
  int back = -1;
  double support = 0;
};

class ChordSearch {
 public:
  ChordSearch(const WireSilhouettes& silhouettes, const SilhouetteBridgeOptions& options,
              const SkeletonGraph& skeleton)
      : silhouettes_(silhouettes),
        options_(options),
        samples_(SampleCurvesOf(skeleton, kCurveStep)),
        grid_(samples_.positions, kBeside) {}

  const SampledCurves& samples() const { return samples_; }
  const PointGrid& grid() const { return grid_; }

  // Of the paths through a place that the images show as wire the one that most places support.
  std::optional<Chord> Through(const Vec3& middle, const std::vector<Vec3>& places) const {
    std::vector<Vec3> near;
    for (const Vec3& p : places)
      if ((p - middle).norm() <= options_.max_length) near.push_back(p);
    const CurvesAround curves(grid_, middle, options_.max_length);
    Chord best;
    grid_.ForEachWithin(middle, options_.max_length, [&](int back, const Vec3& end) {
      const Vec3 direction = (middle - end).normalized();
      if (curves.Met(-direction, (middle - end).norm() - kEndReach) >= 0) return;  // before it
      const int front = curves.Met(direction, options_.max_length);
      if (front < 0) return;
      const Polyline path{samples_.positions[front], end};
      const Polyline inside = Inside(path);
      if (Length(path) > options_.max_length || !IsWire(inside) || !IsApart(inside)) return;
      const double support = Support(path, near);
      if (support > best.support) best = {front, back, support};
    });
    return best.front < 0 ? std::nullopt : std::optional(best);
  }

 private:
  // How many places lie on a path, those in its middle for most; nothing for too short a piece.
  double Support(const Polyline& path, const std::vector<Vec3>& places) const {
    double sum = 0;
    std::set<int> steps;
    for (const Vec3& p : places) {
      const auto [arc_length, distance] = Project(path, p);
      if (distance >= kOnPath) continue;
      sum += 1 - distance * distance / (kOnPath * kOnPath);
      steps.insert(static_cast<int>(arc_length / kStep));
    }
    return static_cast<int>(steps.size()) < kMinSteps ? 0 : sum;
  }

  static Polyline Inside(const Polyline& path) {
    Polyline inside;
    for (const Vec3& p : Resample(path, kStep))
      if (std::min((p - path[0]).norm(), (p - path[1]).norm()) >= kEndReach) inside.push_back(p);
    return inside;
  }

  // Whether places keep clear of all curves, and some of them are far from all.
  bool IsApart(const Polyline& inside) const {
    return std::none_of(inside.begin(), inside.end(),
                        [&](const Vec3& p) { return grid_.Nearest(p, kClearance) >= 0; }) &&
           std::any_of(inside.begin(), inside.end(),
                       [&](const Vec3& p) { return grid_.Nearest(p, kFar) < 0; });
  }

  bool IsWire(const Polyline& inside) const {
    return std::all_of(inside.begin(), inside.end(),
                       [&](const Vec3& p) { return silhouettes_.Share(p) >= options_.min_share; });
  }

  const WireSilhouettes& silhouettes_;
  const SilhouetteBridgeOptions& options_;
  SampledCurves samples_;
  PointGrid grid_;
};

// The greatest share of the images that show a place of a path beside all curves, of the places far
// from all: nearer ones may be a curve's own wire.
double ShareBeside(const WireSilhouettes& silhouettes, const Polyline& path,
                   const ChordSearch& search, double radius) {
  double most = 0;
  for (const Vec3& p : path) {
    if (search.grid().Nearest(p, kFar) >= 0) continue;
    most = std::max(most, silhouettes.ShareBeside(p, search.samples().positions, radius));
  }
  return most;
}

double TypicalRadius(const SkeletonGraph& skeleton) {
  std::vector<double> radii;
  for (const EdgeId id : skeleton.Edges()) {
    const SkeletonEdge& edge = skeleton.edge(id);
    radii.insert(radii.end(), edge.radii.begin(), edge.radii.end());
  }
  return Median(std::move(radii));
}

// Adds a curve that ends at two places of others.
void AddBetween(const Polyline& curve, const CurveLocation& front, const CurveLocation& back,
                double radius, SkeletonGraph& skeleton) {
  const NodeId from = skeleton.AddNode(curve.front());
  const NodeId to = skeleton.AddNode(curve.back());
  const EdgeId added =
      skeleton.AddEdge({{from, to}, curve, std::vector<double>(curve.size(), radius), {}});
  JoinLocations(skeleton, {{{added, 0}, front}, {{added, Length(curve)}, back}}, kSnapDistance);
}

}  // namespace

int AddWeakWires(const WireSilhouettes& silhouettes, const SilhouetteBridgeOptions& options,
                 const ObservedPoints& points, SkeletonGraph& skeleton) {
  if (skeleton.empty()) return 0;
  const double radius = TypicalRadius(skeleton);
  std::optional<ChordSearch> search(std::in_place, silhouettes, options, skeleton);
  std::vector<Vec3> places =
      SeenAsWire(BesideCurves(ResampleOnGrid(points, kStep).positions, search->grid()), silhouettes,
                 options.min_share);
  const std::vector<Vec3> middles = BesideCurves(MiddlesOfPieces(places), search->grid());
  std::vector<std::optional<Chord>> chords(middles.size());
  ParallelFor(0, static_cast<int64_t>(middles.size()), 1, [&](int64_t i) {
    if (silhouettes.Parallax(middles[i]) >= kMinParallax)
      chords[i] = search->Through(middles[i], places);
  });
  int added = 0;
  for (size_t i = 0; i < middles.size(); ++i) {
    if (!chords[i] || search->grid().Nearest(middles[i], kBeside) >= 0) continue;
    const std::optional<Chord> chord =
        added == 0 ? chords[i] : search->Through(middles[i], places);  // now ends are different
    if (!chord) continue;
    const SampledCurves& samples = search->samples();
    const std::optional<Polyline> curve = PathThroughSilhouettes(
        silhouettes, {samples.positions[chord->front], samples.positions[chord->back]},
        options.min_share);
    if (!curve || ShareBeside(silhouettes, *curve, *search, radius) < kMinBeside) continue;
    AddBetween(*curve, samples.locations[chord->front], samples.locations[chord->back], radius,
               skeleton);
    ++added;
    search.emplace(silhouettes, options, skeleton);
    places = BesideCurves(places, search->grid());
  }
  return added;
}

}  // namespace curvefusion
