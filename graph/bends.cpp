#include "graph/bends.h"

#include <algorithm>
#include <cmath>

#include "kernel/douglas_peucker.h"

namespace curvefusion {

namespace {

const double kSameAxis = std::cos(20 * M_PI / 180);  // chosen: a helix of less pitch is a bend
// Chosen: chords of an arc lie within a tolerance of it; those of unlike lengths seem to lie
// farther off.
constexpr double kMaxSagittas = 2;

// A corner of the simplified curve.
struct Corner {
  double s = 0;                // arc length of the curve
  double angle = 0;            // of the turn
  Vec3 axis = Vec3::Zero();    // of the turn
  Vec3 before = Vec3::Zero();  // direction into it
  double length_before = 0;    // of the straight piece into it
};

// Corners in a row that are one bend, and where along the curve it begins and ends.
struct CornerRun {
  size_t first = 0;
  size_t last = 0;
  double angle = 0;
  Vec3 axis = Vec3::Zero();
  double begin = 0;
  double end = 0;
};

std::vector<Corner> CornersOf(const Polyline& points, const std::vector<double>& length,
                              double tolerance) {
  const auto deviation = [&](size_t a, size_t k, size_t b) {
    const double t = ClosestParameter(points[a], points[b], points[k]);
    return (points[k] - (1 - t) * points[a] - t * points[b]).norm();
  };
  const std::vector<size_t> kept = DouglasPeucker(points.size(), tolerance, deviation);
  std::vector<Corner> corners;
  for (size_t i = 1; i + 1 < kept.size(); ++i) {
    const Vec3 in = points[kept[i]] - points[kept[i - 1]];
    const Vec3 out = points[kept[i + 1]] - points[kept[i]];
    const Vec3 cross = in.cross(out);
    if (cross.norm() == 0) continue;
    corners.push_back({length[kept[i]], std::atan2(cross.norm(), in.dot(out)), cross.normalized(),
                       in.normalized(), in.norm()});
  }
  return corners;
}

bool AreOneBend(const Corner& a, const Corner& b, double tolerance) {
  if (a.axis.dot(b.axis) < kSameAxis) return false;
  const double sagitta = b.length_before / 2 * std::tan((a.angle + b.angle) / 8);
  return sagitta <= kMaxSagittas * tolerance;
}

CornerRun RunOf(const std::vector<Corner>& corners, size_t first, size_t last) {
  CornerRun run{first, last};
  for (size_t i = first; i <= last; ++i) {
    run.angle += corners[i].angle;
    run.axis += corners[i].angle * corners[i].axis;
  }
  run.axis.normalize();
  const double half_first = corners[first].angle / 2;
  const double half_last = corners[last].angle / 2;
  const double inner = corners[last].s - corners[first].s;
  const double radius = first == last ? 0 : inner / (run.angle - half_first - half_last);
  run.begin = corners[first].s - radius * half_first;
  run.end = corners[last].s + radius * half_last;
  return run;
}

// Bends that would overlap end where they meet.
void Separate(double length, std::vector<CornerRun>& runs) {
  for (size_t i = 0; i < runs.size(); ++i) {
    runs[i].begin = std::max(runs[i].begin, 0.0);
    runs[i].end = std::min(runs[i].end, length);
    if (i == 0 || runs[i - 1].end <= runs[i].begin) continue;
    runs[i - 1].end = runs[i].begin = (runs[i - 1].end + runs[i].begin) / 2;
  }
}

double Rotation(const Vec3& from, const Vec3& to, const Vec3& feed) {
  const Vec3 a = from - from.dot(feed) * feed;
  const Vec3 b = to - to.dot(feed) * feed;
  return std::atan2(feed.dot(a.cross(b)), a.dot(b));
}

}  // namespace

BendList FindBends(const Polyline& points, double tolerance) {
  const std::vector<double> length = CumulativeLength(points);
  const std::vector<Corner> corners = CornersOf(points, length, tolerance);
  std::vector<CornerRun> runs;
  for (size_t first = 0; first < corners.size();) {
    size_t last = first;
    while (last + 1 < corners.size() && AreOneBend(corners[last], corners[last + 1], tolerance)) {
      ++last;
    }
    runs.push_back(RunOf(corners, first, last));
    first = last + 1;
  }
  Separate(length.back(), runs);
  BendList list;
  double done = 0;
  for (size_t i = 0; i < runs.size(); ++i) {
    const CornerRun& run = runs[i];
    Bend bend;
    bend.straight = run.begin - done;
    if (i > 0) bend.rotation = Rotation(runs[i - 1].axis, run.axis, corners[run.first].before);
    bend.angle = run.angle;
    bend.arc = run.end - run.begin;
    bend.radius = bend.arc / bend.angle;
    list.bends.push_back(bend);
    done = run.end;
  }
  list.end = length.back() - done;
  return list;
}

}  // namespace curvefusion
