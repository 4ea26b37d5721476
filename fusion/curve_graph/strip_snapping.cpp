#include "fusion/curve_graph/strip_snapping.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "graph/edge_parts.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// All chosen, not varied: places lie up to 3 mm beside their wire, and strips' middles are told to
// some .2 mm.
constexpr double kStepsAcross[] = {0.001, 0.00025};  // metres, one search after the other
constexpr int kSteps = 3;                            // to all sides
constexpr int kAlike = 3;                            // points to both sides that move alike
constexpr double kCost = 0.02;  // of evidence, a step squared: where no image tells nothing moves

std::vector<Vec2> OffsetsAcross(double step) {
  std::vector<Vec2> offsets;
  for (int b = -kSteps; b <= kSteps; ++b)
    for (int a = -kSteps; a <= kSteps; ++a) offsets.emplace_back(step * a, step * b);
  return offsets;
}

// Two directions across a curve at each of its points, that turn as little as they can along it.
struct Frame {
  Vec3 u, v;
  Vec3 operator*(const Vec2& offset) const { return offset.x() * u + offset.y() * v; }
};

std::vector<Frame> FramesAlong(const std::vector<Vec3>& tangents) {
  std::vector<Frame> frames;
  Vec3 u = tangents[0].unitOrthogonal();
  for (const Vec3& tangent : tangents) {
    const Vec3 turned = u - u.dot(tangent) * tangent;
    u = turned.norm() > 0.1 ? turned.normalized() : tangent.unitOrthogonal();
    frames.push_back({u, tangent.cross(u)});
  }
  return frames;
}

// A point and those around it that move alike.
EdgePart Around(size_t i, size_t count) {
  return {i < kAlike ? 0 : i - kAlike, std::min(count - 1, i + kAlike)};
}

double CountOf(const EdgePart& part) { return static_cast<double>(PointCount(part)); }

// The offset of each point with which it and those around it have most evidence.
std::vector<Vec2> BestOffsets(const std::vector<double>& evidence, double step,
                              const std::vector<Vec2>& offsets) {
  const size_t count = evidence.size() / offsets.size();
  std::vector<Vec2> best(count, Vec2::Zero());
  for (size_t i = 0; i < count; ++i) {
    const EdgePart around = Around(i, count);
    double most = -std::numeric_limits<double>::infinity();
    for (size_t k = 0; k < offsets.size(); ++k) {
      double sum = 0;
      for (size_t j = around.first; j <= around.last; ++j) sum += evidence[j * offsets.size() + k];
      const double gain = sum / CountOf(around) - kCost * offsets[k].squaredNorm() / (step * step);
      if (gain <= most) continue;
      most = gain;
      best[i] = offsets[k];
    }
  }
  return best;
}

Polyline Snapped(const StripViews& views, const Polyline& points, double step) {
  const std::vector<Vec2> offsets = OffsetsAcross(step);
  const std::vector<Vec3> tangents = Tangents(points);
  const std::vector<Frame> frames = FramesAlong(tangents);
  std::vector<double> evidence(points.size() * offsets.size());
  ParallelFor(0, static_cast<int64_t>(evidence.size()), 32, [&](int64_t at) {
    const size_t i = at / offsets.size();
    const Vec3 p = points[i] + frames[i] * offsets[at % offsets.size()];
    evidence[at] = views.Along(p, tangents[i]).Sum();
  });
  const std::vector<Vec2> best = BestOffsets(evidence, step, offsets);
  Polyline snapped = points;
  for (size_t i = 0; i < points.size(); ++i) {
    const EdgePart around = Around(i, points.size());
    Vec2 sum = Vec2::Zero();
    for (size_t j = around.first; j <= around.last; ++j) sum += best[j];
    snapped[i] += frames[i] * Vec2(sum / CountOf(around));
  }
  return snapped;
}

// The curves of edges; their nodes move to the mean of what the ends of their edges moved to.
void SetCurves(std::map<EdgeId, Polyline> snapped, SkeletonGraph& curves) {
  std::map<NodeId, std::pair<Vec3, int>> ends;
  for (const auto& [id, points] : snapped) {
    for (int end = 0; end < 2; ++end) {
      auto& [sum, count] =
          ends.try_emplace(curves.edge(id).nodes[end], Vec3::Zero(), 0).first->second;
      sum += end == 0 ? points.front() : points.back();
      ++count;
    }
  }
  for (const auto& [node, of_edges] : ends) curves.MoveNode(node, of_edges.first / of_edges.second);
  for (auto& [id, points] : snapped) {
    const SkeletonEdge& edge = curves.edge(id);
    points.front() = curves.position(edge.nodes[0]);
    points.back() = curves.position(edge.nodes[1]);
    curves.SetCurve(id, std::move(points), edge.radii, edge.observations);
  }
}

}  // namespace

void SnapToStrips(const StripViews& views, SkeletonGraph& curves) {
  for (const double step : kStepsAcross) {
    std::map<EdgeId, Polyline> snapped;
    for (const EdgeId id : curves.Edges())
      snapped[id] = Snapped(views, curves.edge(id).points, step);
    SetCurves(std::move(snapped), curves);
  }
}

}  // namespace curvefusion
