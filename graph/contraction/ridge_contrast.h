#pragma once

#include <vector>

#include "kernel/geometry.h"
#include "kernel/observed_points.h"
#include "kernel/options.h"
#include "kernel/point_grid.h"

namespace curvefusion {

/// When a ridge is noise beside stronger wires. Deviation: CurveFusion has no such test.
struct RidgeContrastOptions {
  double ball_radius = 0.004;     ///< metres: what was seen of a place are the points so near to it
  double flank_distance = 0.010;  ///< metres: how far beside a ridge noise is looked for
  double neighbourhood = 0.025;   ///< metres: a ridge is compared with the best one so near
  double min_share = 0.3;
};
void VisitOptions(RidgeContrastOptions& options, OptionVisitor& visitor);

/// On which sides of a ridge noise is looked for.
enum class RidgeSides {
  kSeen,   ///< beside it as the camera saw it, where the rays are known and agree
  kAround  ///< whichever way across: also along the rays, where the noise of depth lies
};

/// What was seen at places on ridges, each of unit direction: counts of points within a ball, found
/// by a grid of the points. All but the options must outlive it; places.size() must be
/// directions.size(). Costs O(n k) for k points in a ball.
class RidgeContrast {
 public:
  RidgeContrast(const ObservedPoints& points, const PointGrid& grid,
                const std::vector<Vec3>& places, const std::vector<Vec3>& directions,
                const RidgeContrastOptions& options);

  double Own(size_t place) const { return own_[place]; }
  /// At the best place in the neighbourhood.
  double Best(size_t place) const { return best_[place]; }
  /// On the emptier of two opposite sides, for the two of which that is most.
  double Flank(size_t place, RidgeSides sides) const;

 private:
  const ObservedPoints& points_;
  const std::vector<Vec3>& places_;
  const std::vector<Vec3>& directions_;
  RidgeContrastOptions options_;
  const PointGrid& grid_;
  std::vector<double> own_;
  std::vector<double> best_;
};

/// For each place, whether it is a wire of its own: nearly as much was seen there as at the best
/// place in the neighbourhood, or hardly anything on one of two opposite sides. Between wires the
/// sensor scatters points that make weak ridges but fill both sides; a wire seen seldom has a clear
/// side.
std::vector<char> StandsOut(const ObservedPoints& points, const std::vector<Vec3>& places,
                            const std::vector<Vec3>& directions,
                            const RidgeContrastOptions& options);

}  // namespace curvefusion
