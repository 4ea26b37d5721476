#include "meshing/tube_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kernel/angle.h"
#include "kernel/douglas_peucker.h"
#include "meshing/tube_envelope.h"

namespace curvefusion {

namespace {

// A ring stands clear of the next by this factor over what just avoids folding.
constexpr double kFoldMargin = 1.15;
// Where the radius changes faster than this per length, the tube is a jump and no cone.
constexpr double kMaxRadiusSlope = 0.5;

std::vector<size_t> PointsWithinTolerance(const TubeAxis& axis, double tolerance) {
  return DouglasPeucker(axis.points.size(), tolerance, [&axis](size_t a, size_t k, size_t b) {
    return ChordDeviation(axis, a, k, b);
  });
}

// Drops points nearer than min_spacing radii to their neighbour, the less telling of two first.
std::vector<size_t> ThinOut(const TubeAxis& axis, const std::vector<size_t>& kept,
                            double min_spacing) {
  std::vector<size_t> thinned = {kept.front()};
  for (size_t i = 1; i < kept.size(); ++i) {
    const bool last = i + 1 == kept.size();
    bool drop_this = false;
    while (!drop_this) {
      const size_t before = thinned.back();
      const double radius = std::max(axis.radii[before], axis.radii[kept[i]]);
      if ((axis.points[kept[i]] - axis.points[before]).norm() >= min_spacing * radius) break;
      const bool before_is_free = thinned.size() > 1;
      if (!before_is_free && last) break;
      drop_this = !last && (!before_is_free ||
                            ChordDeviation(axis, before, kept[i], kept[i + 1]) <
                                ChordDeviation(axis, thinned[thinned.size() - 2], before, kept[i]));
      if (!drop_this) thinned.pop_back();
    }
    if (!drop_this) thinned.push_back(kept[i]);
  }
  return thinned;
}

// The turn of the axis at the k-th kept point.
double TurnAt(const TubeAxis& axis, const std::vector<size_t>& kept, size_t k) {
  if (k == 0 || k + 1 >= kept.size()) return 0;
  return AngleBetween(axis.points[kept[k]] - axis.points[kept[k - 1]],
                      axis.points[kept[k + 1]] - axis.points[kept[k]]);
}

// Whether a tube would have to be cut at one of the ends of the segment after the k-th kept point.
bool NeedsCut(const TubeAxis& axis, const std::vector<size_t>& kept, size_t k, double max_turn) {
  const double before = TurnAt(axis, kept, k);
  const double after = TurnAt(axis, kept, k + 1);
  const double radius = std::max(axis.radii[kept[k]], axis.radii[kept[k + 1]]);
  const double length = (axis.points[kept[k + 1]] - axis.points[kept[k]]).norm();
  return std::max(before, after) > max_turn || StripFolds(length, radius, before, after);
}

// How far the axis would be from its simplification without the k-th kept point.
double DeviationWithout(const TubeAxis& axis, const std::vector<size_t>& kept, size_t k) {
  if (k == 0 || k + 1 >= kept.size()) return std::numeric_limits<double>::infinity();
  double deviation = 0;
  for (size_t i = kept[k - 1] + 1; i < kept[k + 1]; ++i) {
    deviation = std::max(deviation, ChordDeviation(axis, kept[k - 1], i, kept[k + 1]));
  }
  return deviation;
}

std::vector<size_t> Without(std::vector<size_t> kept, size_t k) {
  kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(k));
  return kept;
}

// Drops points at kinks that are as small as noise, where that lets a tube be swept: a bend that is
// tight at every scale keeps its shape and is cut.
std::vector<size_t> SmoothKinks(const TubeAxis& axis, std::vector<size_t> kept,
                                const AxisOptions& options) {
  for (size_t k = 0; k + 1 < kept.size();) {
    std::vector<size_t> smoothed;
    double deviation = options.kink_tolerance;
    if (NeedsCut(axis, kept, k, options.max_turn)) {
      for (const size_t i : {k, k + 1}) {
        const double d = DeviationWithout(axis, kept, i);
        if (d > deviation) continue;
        std::vector<size_t> candidate = Without(kept, i);
        if (NeedsCut(axis, candidate, i - 1, options.max_turn)) continue;
        deviation = d;
        smoothed = std::move(candidate);
      }
    }
    if (smoothed.empty()) {
      ++k;
      continue;
    }
    kept = std::move(smoothed);
    k = k > 2 ? k - 2 : 0;
  }
  return kept;
}

// Position and radius.
Eigen::Vector4d At(const TubeAxis& axis, size_t i) {
  return {axis.points[i].x(), axis.points[i].y(), axis.points[i].z(), axis.radii[i]};
}

// The normal equations of the piecewise linear curve with free values at kept points that is
// nearest to an axis in the mean over its length; tridiagonal.
struct NormalEquations {
  std::vector<double> diagonal, next;  // entries (k, k) and (k, k + 1)
  std::vector<Eigen::Vector4d> right;

  NormalEquations(const TubeAxis& axis, const std::vector<size_t>& kept)
      : diagonal(kept.size(), 0.0),
        next(kept.size(), 0.0),
        right(kept.size(), Eigen::Vector4d::Zero()) {
    for (size_t k = 0; k + 1 < kept.size(); ++k) {
      const double length = LengthBetween(axis, kept[k], kept[k + 1]);
      double along = 0;
      for (size_t i = kept[k]; i < kept[k + 1]; ++i) {
        const double step = (axis.points[i + 1] - axis.points[i]).norm();
        // Simpson's rule is exact for products of linear functions.
        Add(k, along / length, step / 6, At(axis, i));
        Add(k, (along + step / 2) / length, 4 * step / 6, (At(axis, i) + At(axis, i + 1)) / 2);
        along += step;
        Add(k, along / length, step / 6, At(axis, i + 1));
      }
    }
  }

  static double LengthBetween(const TubeAxis& axis, size_t first, size_t last) {
    double length = 0;
    for (size_t i = first; i < last; ++i) length += (axis.points[i + 1] - axis.points[i]).norm();
    return length;
  }

  void Add(size_t k, double t, double weight, const Eigen::Vector4d& value) {
    diagonal[k] += weight * (1 - t) * (1 - t);
    diagonal[k + 1] += weight * t * t;
    next[k] += weight * t * (1 - t);
    right[k] += weight * (1 - t) * value;
    right[k + 1] += weight * t * value;
  }
};

// The values of the inner points that fit best while both ends stay (Thomas' algorithm).
std::vector<Eigen::Vector4d> Solve(NormalEquations equations, const Eigen::Vector4d& first,
                                   const Eigen::Vector4d& last) {
  const size_t n = equations.diagonal.size();
  std::vector<Eigen::Vector4d> values(n, last);
  values.front() = first;
  if (n < 3) return values;
  equations.right[1] -= equations.next[0] * first;
  equations.right[n - 2] -= equations.next[n - 2] * last;
  for (size_t k = 2; k + 1 < n; ++k) {
    const double factor = equations.next[k - 1] / equations.diagonal[k - 1];
    equations.diagonal[k] -= factor * equations.next[k - 1];
    equations.right[k] -= factor * equations.right[k - 1];
  }
  values[n - 2] = equations.right[n - 2] / equations.diagonal[n - 2];
  for (size_t k = n - 3; k > 0; --k) {
    values[k] = (equations.right[k] - equations.next[k] * values[k + 1]) / equations.diagonal[k];
  }
  return values;
}

// The kept points, moved half way to where they fit the axis best: chords of a bend lie on its
// inner side and are shorter than it; where they fit best they are too long by as much.
TubeAxis FittedAxis(const TubeAxis& axis, const std::vector<size_t>& kept) {
  const std::vector<Eigen::Vector4d> best =
      Solve(NormalEquations(axis, kept), At(axis, kept.front()), At(axis, kept.back()));
  TubeAxis fitted;
  for (size_t k = 0; k < kept.size(); ++k) {
    fitted.points.emplace_back((axis.points[kept[k]] + best[k].head<3>()) / 2);
    fitted.radii.push_back((axis.radii[kept[k]] + best[k][3]) / 2);
  }
  return fitted;
}

}  // namespace

double ChordDeviation(const TubeAxis& axis, size_t a, size_t k, size_t b) {
  const double t = ClosestParameter(axis.points[a], axis.points[b], axis.points[k]);
  const Vec3 on_chord = axis.points[a] + t * (axis.points[b] - axis.points[a]);
  const double radius_on_chord = axis.radii[a] + t * (axis.radii[b] - axis.radii[a]);
  const double offset = (axis.points[k] - on_chord).norm();
  return std::max(offset, std::abs(axis.radii[k] - radius_on_chord)) / axis.radii[k];
}

void AppendAxis(const TubeAxis& tail, TubeAxis& axis) {
  axis.points.insert(axis.points.end(), tail.points.begin(), tail.points.end());
  axis.radii.insert(axis.radii.end(), tail.radii.begin(), tail.radii.end());
}

TubeAxis WithoutRepeatedPoints(const TubeAxis& axis) {
  TubeAxis distinct;
  for (size_t i = 0; i < axis.points.size(); ++i) {
    if (i > 0 && distinct.points.back() == axis.points[i]) continue;
    distinct.points.push_back(axis.points[i]);
    distinct.radii.push_back(axis.radii[i]);
  }
  return distinct;
}

TubeAxis SmoothAxis(const TubeAxis& axis) { return FitToEnvelope(WithoutRepeatedPoints(axis)); }

TubeAxis SimplifyAxis(const TubeAxis& axis, const AxisOptions& options) {
  std::vector<size_t> kept = PointsWithinTolerance(axis, options.tolerance);
  kept = SmoothKinks(axis, ThinOut(axis, kept, options.min_spacing), options);
  return FittedAxis(axis, kept);
}

double TurnAngleAt(const Polyline& points, size_t i) {
  return AngleBetween(points[i] - points[i - 1], points[i + 1] - points[i]);
}

bool StripFolds(double length, double radius, double first_turn, double last_turn) {
  const double reach =
      std::tan(std::min(first_turn, 3.0) / 2) + std::tan(std::min(last_turn, 3.0) / 2);
  return length < kFoldMargin * radius * reach;
}

std::vector<int> FindCuts(const TubeAxis& axis, double max_turn) {
  const int n = static_cast<int>(axis.points.size());
  std::vector<double> turn(n, 0.0);
  std::vector<char> cut(n, 0);
  const auto cut_at = [&](int i) {
    turn[i] = 0;
    cut[i] = i > 0 && i + 1 < n;
  };
  for (int i = 1; i + 1 < n; ++i) {
    turn[i] = TurnAngleAt(axis.points, i);
    if (turn[i] > max_turn) cut_at(i);
  }
  for (int i = 0; i + 1 < n; ++i) {
    const double length = (axis.points[i + 1] - axis.points[i]).norm();
    if (std::abs(axis.radii[i + 1] - axis.radii[i]) > kMaxRadiusSlope * length) {
      cut_at(i);
      cut_at(i + 1);
    }
    const double radius = std::max(axis.radii[i], axis.radii[i + 1]);
    while (StripFolds(length, radius, turn[i], turn[i + 1])) {
      cut_at(turn[i] > turn[i + 1] ? i : i + 1);
    }
  }
  std::vector<int> cuts;
  for (int i = 0; i < n; ++i) {
    if (cut[i]) cuts.push_back(i);
  }
  return cuts;
}

TubeAxis Slice(const TubeAxis& axis, int first, int last) {
  return {{axis.points.begin() + first, axis.points.begin() + last + 1},
          {axis.radii.begin() + first, axis.radii.begin() + last + 1}};
}

TubeAxis SubdivideAxis(const TubeAxis& axis, double max_spacing) {
  TubeAxis fine;
  for (size_t i = 0; i + 1 < axis.points.size(); ++i) {
    const Vec3 step = axis.points[i + 1] - axis.points[i];
    const double radius = std::min(axis.radii[i], axis.radii[i + 1]);
    const int parts =
        std::max(1, static_cast<int>(std::ceil(step.norm() / (max_spacing * radius))));
    for (int k = 0; k < parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      fine.points.push_back(axis.points[i] + t * step);
      fine.radii.push_back(axis.radii[i] + t * (axis.radii[i + 1] - axis.radii[i]));
    }
  }
  fine.points.push_back(axis.points.back());
  fine.radii.push_back(axis.radii.back());
  return fine;
}

}  // namespace curvefusion
