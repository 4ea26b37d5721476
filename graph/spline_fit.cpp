#include "graph/spline_fit.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "kernel/polyline.h"

namespace curvefusion {

namespace {

using Vec4 = Eigen::Vector4d;  // position and radius

constexpr double kMaxSamples = 20000;  // chosen: 10 m at .5 mm, a second of fitting
constexpr size_t kMinSpanSamples = 4;  // of a span that is halved; chosen: each half keeps two

// Places along the polyline by arc length.
struct Samples {
  std::vector<double> s;
  std::vector<Vec4> values;
};

struct Fit {
  std::vector<double> knots;
  std::vector<Vec4> control;
  std::vector<double> span_error;  // of each span between different knots
  double error = 0;
};

Samples SampleEdge(const SkeletonEdge& edge, double tolerance) {
  const std::vector<double> length = CumulativeLength(edge.points);
  const double step = std::max(tolerance, length.back() / kMaxSamples);
  const auto value = [&](size_t i) {
    const Vec3& p = edge.points[i];
    return Vec4(p.x(), p.y(), p.z(), edge.radii.empty() ? 0 : edge.radii[i]);
  };
  Samples samples{{0}, {value(0)}};
  for (size_t i = 1; i < edge.points.size(); ++i) {
    const double segment = length[i] - length[i - 1];
    const int pieces = std::max(1, static_cast<int>(std::ceil(segment / step)));
    for (int k = 1; k <= pieces; ++k) {
      const double share = static_cast<double>(k) / pieces;
      samples.s.push_back(length[i - 1] + share * segment);
      samples.values.push_back(k == pieces ? value(i)
                                           : (1 - share) * value(i - 1) + share * value(i));
    }
  }
  return samples;
}

// The last knot not behind a parameter that has another one behind it.
size_t SpanOf(const std::vector<double>& knots, double s) {
  const auto after =
      std::upper_bound(knots.begin() + kSplineDegree + 1, knots.end() - kSplineDegree - 1, s);
  return static_cast<size_t>(after - knots.begin()) - 1;
}

// The four basis functions that are not zero in a span (Cox and de Boor).
std::array<double, kSplineDegree + 1> Basis(const std::vector<double>& knots, size_t span,
                                            double s) {
  std::array<double, kSplineDegree + 1> basis = {1, 0, 0, 0};
  for (int degree = 1; degree <= kSplineDegree; ++degree) {
    double carried = 0;
    for (int k = 0; k < degree; ++k) {
      const double right = knots[span + 1 + static_cast<size_t>(k)];
      const double left = knots[span + 1 + static_cast<size_t>(k) - static_cast<size_t>(degree)];
      const double part = basis[static_cast<size_t>(k)] / (right - left);
      basis[static_cast<size_t>(k)] = carried + (right - s) * part;
      carried = (s - left) * part;
    }
    basis[static_cast<size_t>(degree)] = carried;
  }
  return basis;
}

Vec4 Evaluate(const std::vector<double>& knots, const std::vector<Vec4>& control, double s) {
  const size_t span = SpanOf(knots, s);
  const auto basis = Basis(knots, span, s);
  Vec4 sum = Vec4::Zero();
  for (size_t k = 0; k <= kSplineDegree; ++k) sum += basis[k] * control[span - kSplineDegree + k];
  return sum;
}

// Least squares over all samples, the first and last control point given. False where they do not
// determine the others.
bool SolveControl(const Samples& samples, Fit& fit) {
  const int count = static_cast<int>(fit.knots.size()) - kSplineDegree - 1;
  const int unknowns = count - 2;
  fit.control.assign(static_cast<size_t>(count), Vec4::Zero());
  fit.control.front() = samples.values.front();
  fit.control.back() = samples.values.back();
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::Matrix<double, Eigen::Dynamic, 4> right =
      Eigen::Matrix<double, Eigen::Dynamic, 4>::Zero(unknowns, 4);
  for (size_t i = 1; i + 1 < samples.s.size(); ++i) {
    const size_t span = SpanOf(fit.knots, samples.s[i]);
    const auto basis = Basis(fit.knots, span, samples.s[i]);
    const int first = static_cast<int>(span) - kSplineDegree - 1;  // unknown of basis[0]
    Vec4 rest = samples.values[i];
    for (int k = 0; k <= kSplineDegree; ++k) {
      const int row = first + k;
      if (row == -1 || row == unknowns) {
        rest -=
            basis[static_cast<size_t>(k)] * (row == -1 ? fit.control.front() : fit.control.back());
      }
    }
    for (int k = 0; k <= kSplineDegree; ++k) {
      const int row = first + k;
      if (row < 0 || row >= unknowns) continue;
      right.row(row) += basis[static_cast<size_t>(k)] * rest.transpose();
      for (int j = 0; j <= kSplineDegree; ++j) {
        const int column = first + j;
        if (column < 0 || column >= unknowns) continue;
        entries.emplace_back(row, column,
                             basis[static_cast<size_t>(k)] * basis[static_cast<size_t>(j)]);
      }
    }
  }
  Eigen::SparseMatrix<double> normal(unknowns, unknowns);
  normal.setFromTriplets(entries.begin(), entries.end());
  // In their given order, in which the matrix is a band.
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>>
      solver(normal);
  if (solver.info() != Eigen::Success) return false;
  const Eigen::Matrix<double, Eigen::Dynamic, 4> solution = solver.solve(right);
  if (!solution.allFinite()) return false;
  for (int i = 0; i < unknowns; ++i) fit.control[static_cast<size_t>(i) + 1] = solution.row(i);
  return true;
}

// The error at all samples and in the middle between them, up to where it exceeds `limit`.
void MeasureError(const Samples& samples, double limit, Fit& fit) {
  fit.span_error.assign(fit.knots.size(), 0);
  const auto measure = [&](double s, const Vec4& value) {
    const double error = (Evaluate(fit.knots, fit.control, s) - value).head<3>().norm();
    double& worst = fit.span_error[SpanOf(fit.knots, s)];
    worst = std::max(worst, error);
    fit.error = std::max(fit.error, error);
  };
  fit.error = 0;
  for (size_t i = 0; i < samples.s.size() && fit.error <= limit; ++i) {
    measure(samples.s[i], samples.values[i]);
    if (i == 0) continue;
    measure((samples.s[i] + samples.s[i - 1]) / 2, (samples.values[i] + samples.values[i - 1]) / 2);
  }
}

std::optional<Fit> FitKnots(const Samples& samples, std::vector<double> knots,
                            double limit = std::numeric_limits<double>::infinity()) {
  Fit fit;
  fit.knots = std::move(knots);
  if (!SolveControl(samples, fit)) return std::nullopt;
  MeasureError(samples, limit, fit);
  return fit;
}

// The knots with one more in the middle of every span that is off by more than the tolerance; as
// many as before where none of them has samples enough.
std::vector<double> Refined(const Fit& fit, const Samples& samples, double tolerance) {
  std::vector<double> knots;
  for (size_t i = 0; i < fit.knots.size(); ++i) {
    knots.push_back(fit.knots[i]);
    if (fit.span_error[i] <= tolerance) continue;
    const auto begin = std::lower_bound(samples.s.begin(), samples.s.end(), fit.knots[i]);
    const auto end = std::lower_bound(samples.s.begin(), samples.s.end(), fit.knots[i + 1]);
    const auto inside = static_cast<size_t>(end - begin);
    if (inside >= kMinSpanSamples) {
      knots.push_back(*(begin + static_cast<std::ptrdiff_t>(inside / 2)));
    }
  }
  return knots;
}

// Takes out every inner knot without which the fit still is good enough.
Fit Reduced(Fit fit, const Samples& samples, double tolerance) {
  for (size_t i = fit.knots.size() - kSplineDegree - 2; i > kSplineDegree; --i) {
    std::vector<double> fewer = fit.knots;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    auto smaller = FitKnots(samples, std::move(fewer), tolerance);
    if (smaller && smaller->error <= tolerance) fit = std::move(*smaller);
  }
  return fit;
}

// The polyline itself: straight Bezier pieces, so three equal knots at every vertex.
Fit PolylineSpline(const SkeletonEdge& edge) {
  const std::vector<double> length = CumulativeLength(edge.points);
  const auto value = [&](size_t i) {
    const Vec3& p = edge.points[i];
    return Vec4(p.x(), p.y(), p.z(), edge.radii.empty() ? 0 : edge.radii[i]);
  };
  Fit fit;
  fit.knots.push_back(0);
  fit.control.push_back(value(0));
  for (size_t i = 0; i < edge.points.size(); ++i) {
    fit.knots.insert(fit.knots.end(), kSplineDegree, length[i]);
    if (i == 0) continue;
    fit.control.push_back((2 * value(i - 1) + value(i)) / 3);
    fit.control.push_back((value(i - 1) + 2 * value(i)) / 3);
    fit.control.push_back(value(i));
  }
  fit.knots.push_back(length.back());
  return fit;
}

Fit FitWithin(const SkeletonEdge& edge, double tolerance) {
  const Samples samples = SampleEdge(edge, tolerance);
  const double length = samples.s.back();
  std::vector<double> knots(kSplineDegree + 1, 0);
  knots.insert(knots.end(), kSplineDegree + 1, length);
  // Four samples determine the two inner control points of one span.
  if (samples.s.size() < kMinSpanSamples) return PolylineSpline(edge);
  while (true) {
    auto fit = FitKnots(samples, knots);
    if (!fit) return PolylineSpline(edge);
    if (fit->error <= tolerance) return Reduced(std::move(*fit), samples, tolerance);
    std::vector<double> finer = Refined(*fit, samples, tolerance);
    if (finer.size() == knots.size()) return PolylineSpline(edge);
    knots = std::move(finer);
  }
}

// The polar form of the span's cubic: its Bezier points are those of the span's ends.
Vec4 Blossom(const std::vector<double>& knots, const std::vector<Vec4>& control, size_t span,
             const std::array<double, kSplineDegree>& at) {
  std::array<Vec4, kSplineDegree + 1> points;
  for (size_t k = 0; k <= kSplineDegree; ++k) points[k] = control[span - kSplineDegree + k];
  for (size_t round = 1; round <= kSplineDegree; ++round) {
    for (size_t k = kSplineDegree; k >= round; --k) {
      const double left = knots[span - kSplineDegree + k];
      const double right = knots[span + 1 + k - round];
      const double share = (at[round - 1] - left) / (right - left);
      points[k] = (1 - share) * points[k - 1] + share * points[k];
    }
  }
  return points[kSplineDegree];
}

std::vector<Vec4> WithRadii(const CubicSpline& spline) {
  std::vector<Vec4> control;
  for (size_t i = 0; i < spline.points.size(); ++i) {
    const Vec3& p = spline.points[i];
    control.emplace_back(p.x(), p.y(), p.z(), spline.radii.empty() ? 0 : spline.radii[i]);
  }
  return control;
}

}  // namespace

Vec3 CubicSpline::At(double parameter) const {
  return Evaluate(knots, WithRadii(*this), parameter).head<3>();
}

CubicSpline FitSpline(const SkeletonEdge& edge, double tolerance) {
  const Fit fit = FitWithin(edge, tolerance);
  CubicSpline spline;
  spline.knots = fit.knots;
  spline.deviation = fit.error;
  for (const Vec4& control : fit.control) {
    spline.points.emplace_back(control.head<3>());
    if (edge.radii.empty()) continue;
    // Least squares may swing below what the edge has.
    const auto [least, most] = std::minmax_element(edge.radii.begin(), edge.radii.end());
    spline.radii.push_back(std::clamp(control[3], *least, *most));
  }
  return spline;
}

std::vector<Eigen::Vector4d> BezierPoints(const CubicSpline& spline) {
  const std::vector<Vec4> control = WithRadii(spline);
  std::vector<Vec4> bezier = {control.front()};
  for (size_t i = kSplineDegree; i + kSplineDegree + 1 < spline.knots.size(); ++i) {
    const double a = spline.knots[i];
    const double b = spline.knots[i + 1];
    if (!(a < b)) continue;
    bezier.push_back(Blossom(spline.knots, control, i, {a, a, b}));
    bezier.push_back(Blossom(spline.knots, control, i, {a, b, b}));
    bezier.push_back(Blossom(spline.knots, control, i, {b, b, b}));
  }
  bezier.back() = control.back();
  return bezier;
}

}  // namespace curvefusion
