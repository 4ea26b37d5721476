#include "graph/contraction/gap_evidence.h"

namespace curvefusion {

namespace {

constexpr double kStep = 0.001;  // metres; chosen: well below the distances that are looked at
// Chosen, metres: nearer than this a thin density kernel blends curves.
constexpr double kCrossing = 0.005;

std::vector<Vec3> PointsOfCurves(const SkeletonGraph& graph, std::vector<EdgeId>& edges) {
  std::vector<Vec3> positions;
  for (const EdgeId id : graph.Edges()) {
    const Polyline& points = graph.edge(id).points;
    positions.insert(positions.end(), points.begin(), points.end());
    edges.resize(positions.size(), id);
  }
  return positions;
}

}  // namespace

GapEvidence::GapEvidence(const SkeletonGraph& graph, const ObservedPoints& points, double radius)
    : points_(points.positions, radius),
      is_empty_(points.empty()),
      radius_(radius),
      curves_(PointsOfCurves(graph, edges_), kCrossing) {}

double GapEvidence::PointShare(const Vec3& a, const Vec3& b) const {
  const double length = (b - a).norm();
  const int steps = static_cast<int>((length - 2 * radius_) / kStep);
  if (is_empty_ || steps < 1) return 0;
  int seen = 0;
  for (int i = 0; i < steps; ++i) {
    const Vec3 p = a + (radius_ + i * kStep) / length * (b - a);
    seen += points_.Nearest(p, radius_) >= 0 ? 1 : 0;
  }
  return static_cast<double>(seen) / steps;
}

bool GapEvidence::IsCrossed(const Vec3& a, const Vec3& b, const std::array<EdgeId, 2>& own) const {
  const double length = (b - a).norm();
  bool crossed = false;
  for (double at = kCrossing; at <= length - kCrossing && !crossed; at += kStep) {
    curves_.ForEachWithin(a + at / length * (b - a), kCrossing, [&](int i, const Vec3&) {
      crossed |= edges_[i] != own[0] && edges_[i] != own[1];
    });
  }
  return crossed;
}

}  // namespace curvefusion
