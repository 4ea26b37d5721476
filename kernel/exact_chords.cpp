#include "kernel/exact_chords.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

namespace curvefusion {

namespace {

using Number = CGAL::Exact_predicates_exact_constructions_kernel::FT;

// As in kernel/exact.cpp: floating point decides where it is sure.
constexpr double kRelativeError = 1e-13;
constexpr double kSmallest = 1e-100;
constexpr double kLargest = 1e100;

// A chord in metres along the segment: its middle, and bounds on half its length.
struct RoundedChord {
  double middle;
  double least_half;
  double greatest_half;
  double margin;  // more than the error of each

  RoundedChord(const Segment& s, const Vec3& p, double distance) {
    const Vec3 u = s.b - s.a;
    const Vec3 w = p - s.a;
    const double length = u.norm();
    middle = w.dot(u) / length;
    margin = kRelativeError * (w.norm() + distance);
    const double beside = w.cross(u).norm() / length;
    least_half = Half(beside + margin, distance);
    greatest_half = Half(std::max(0.0, beside - margin), distance);
  }

  static double Half(double beside, double distance) {
    return beside < distance ? std::sqrt((distance - beside) * (distance + beside)) : 0;
  }
};

bool IsOfOrdinarySize(const Segment& s, const Vec3& p, const Vec3& q, double distance) {
  const double length = (s.b - s.a).cwiseAbs().maxCoeff();
  const double far =
      std::max((p - s.a).cwiseAbs().maxCoeff(), (q - s.a).cwiseAbs().maxCoeff()) + distance;
  return length > kSmallest && distance > kSmallest && length < kLargest && far < kLargest;
}

// With the length of the segment as unit of length, squared numbers are rational: the middle of a
// chord is `middle` / `unit`, half of it the root of `squared_half` / `unit`.
struct ExactChord {
  Number middle;
  Number squared_half;

  ExactChord(const Segment& s, const Vec3& p, double distance) {
    Number ww(0), wu(0), uu(0);
    for (int i = 0; i < 3; ++i) {
      const Number w = Number(p[i]) - Number(s.a[i]);
      const Number u = Number(s.b[i]) - Number(s.a[i]);
      ww += w * w;
      wu += w * u;
      uu += u * u;
    }
    middle = wu;
    squared_half = wu * wu - uu * (ww - Number(distance) * Number(distance));
  }
};

// Whether x <= sqrt(a) + sqrt(b).
bool IsAtMostSumOfRoots(const Number& x, const Number& a, const Number& b) {
  if (x <= Number(0)) return true;
  const Number excess = x * x - a - b;
  return excess <= Number(0) || excess * excess <= Number(4) * a * b;
}

// Whether x > sqrt(a) - sqrt(b).
bool IsAboveDifferenceOfRoots(const Number& x, const Number& a, const Number& b) {
  const Number excess = a - x * x - b;  // squared: below 2 x sqrt(b) for x >= 0
  if (x >= Number(0)) return excess < Number(0) || excess * excess < Number(4) * x * x * b;
  // -x < sqrt(b) - sqrt(a)
  const Number rest = b - x * x - a;
  return rest > Number(0) && rest * rest > Number(4) * x * x * a;
}

}  // namespace

bool AreInOrder(const Segment& s, const Vec3& p, const Vec3& q, double distance) {
  if (IsOfOrdinarySize(s, p, q, distance)) {
    const RoundedChord a(s, p, distance);
    const RoundedChord b(s, q, distance);
    const double back = a.middle - b.middle;
    const double margin = 2 * (a.margin + b.margin);
    if (back + margin <= a.least_half + b.least_half) return true;
    if (back - margin > a.greatest_half + b.greatest_half) return false;
  }
  const ExactChord a(s, p, distance);
  const ExactChord b(s, q, distance);
  return IsAtMostSumOfRoots(a.middle - b.middle, a.squared_half, b.squared_half);
}

bool BeginsLater(const Segment& s, const Vec3& p, const Vec3& q, double distance) {
  if (IsOfOrdinarySize(s, p, q, distance)) {
    const RoundedChord a(s, p, distance);
    const RoundedChord b(s, q, distance);
    const double ahead = a.middle - b.middle;
    const double margin = 2 * (a.margin + b.margin);
    if (ahead - margin > a.greatest_half - b.least_half) return true;
    if (ahead + margin <= a.least_half - b.greatest_half) return false;
  }
  const ExactChord a(s, p, distance);
  const ExactChord b(s, q, distance);
  return IsAboveDifferenceOfRoots(a.middle - b.middle, a.squared_half, b.squared_half);
}

double ChordBegin(const Segment& s, const Vec3& p, double distance) {
  const RoundedChord chord(s, p, distance);
  return std::clamp((chord.middle - chord.least_half) / (s.b - s.a).norm(), 0.0, 1.0);
}

}  // namespace curvefusion
