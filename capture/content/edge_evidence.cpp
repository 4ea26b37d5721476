#include "capture/content/edge_evidence.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "capture/content/depth_edges.h"
#include "capture/frame_stream.h"
#include "kernel/error.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr double kReferenceWidth = 640;
constexpr double kMinInside = 0.7;  // chosen: a shift of 100 px still leaves so many in the image

struct FrameEvidence {
  std::vector<EdgePoint> points;
  EdgeDistance distance;
};

FrameEvidence GatherFrame(const Sequence& sequence, int frame, int points) {
  FrameEvidence evidence;
  const DepthImage depth = LoadDepth(sequence, frame);
  evidence.distance = EdgeDistance(LoadColor(sequence, frame));
  for (const DepthEdgePoint& edge : FindDepthEdges(depth, points)) {
    const Vec3 p_depth = sequence.depth_camera.Unproject(edge.u, edge.v, edge.depth);
    evidence.points.push_back(
        {sequence.T_color_depth.linear() * p_depth, EdgeDistance::DirectionOf(edge.angle), 0});
  }
  return evidence;
}

}  // namespace

ColourParameters EdgeEvidence::Given() const {
  const Vec3 offset = T_color_depth.translation();
  return {given_camera.fx, given_camera.cx, given_camera.cy, offset.x(), offset.y()};
}

double EdgeEvidence::Depth(const EdgePoint& point) const {
  return point.position.z() + T_color_depth.translation().z();
}

Vec2 EdgeEvidence::Project(const ColourParameters& x, const EdgePoint& point) const {
  const double z = Depth(point);
  return {x[kF] * (point.position.x() + x[kTx]) / z + x[kCx],
          x[kF] * aspect() * (point.position.y() + x[kTy]) / z + x[kCy]};
}

EdgeEvidence GatherEdgeEvidence(const Sequence& sequence, int max_frames, int points_per_frame) {
  const std::vector<int> frames = EvenlyThinned(AllFrames(sequence), max_frames);
  std::vector<FrameEvidence> gathered(frames.size());
  ParallelFor(0, static_cast<int64_t>(frames.size()), 1, [&](int64_t i) {
    try {
      gathered[static_cast<size_t>(i)] =
          GatherFrame(sequence, frames[static_cast<size_t>(i)], points_per_frame);
    } catch (const Error&) {  // the survey of the images names it
    }
  });
  EdgeEvidence evidence;
  evidence.given_camera = sequence.color_camera;
  evidence.T_color_depth = sequence.T_color_depth;
  evidence.scale = sequence.color_camera.width / kReferenceWidth;
  for (FrameEvidence& frame : gathered) {
    if (frame.points.empty()) continue;
    for (EdgePoint& point : frame.points) {
      point.frame = static_cast<int>(evidence.distances.size());
      evidence.points.push_back(point);
    }
    evidence.distances.push_back(std::move(frame.distance));
  }
  return evidence;
}

double Closeness(double distance, double sigma) {
  return std::exp(-0.5 * (distance / sigma) * (distance / sigma));
}

double EdgeShare(const EdgeEvidence& evidence, const ColourParameters& x,
                 const EdgeSelection& selection, double sigma) {
  double sum = 0, inside = 0;
  for (const size_t i : selection) {
    const EdgePoint& point = evidence.points[i];
    const EdgeDistance& distance = evidence.distances[static_cast<size_t>(point.frame)];
    const Vec2 pixel = evidence.Project(x, point);
    if (!distance.Contains(pixel)) continue;
    ++inside;
    sum += Closeness(distance.Nearest(pixel, point.direction), sigma);
  }
  const double least = kMinInside * static_cast<double>(selection.size());
  return inside > 0 ? sum / std::max(inside, least) : 0;
}

double MeanEdgeDistance(const EdgeEvidence& evidence, const ColourParameters& x) {
  double sum = 0;
  size_t count = 0;
  for (const EdgePoint& point : evidence.points) {
    const EdgeDistance& distance = evidence.distances[static_cast<size_t>(point.frame)];
    const Vec2 pixel = evidence.Project(x, point);
    if (!distance.Contains(pixel)) continue;
    sum += distance.Nearest(pixel, point.direction);
    ++count;
  }
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

double Displacement(const EdgeEvidence& evidence, const ColourParameters& a,
                    const ColourParameters& b) {
  double sum = 0;
  for (const EdgePoint& point : evidence.points) {
    sum += (evidence.Project(a, point) - evidence.Project(b, point)).norm();
  }
  return sum / static_cast<double>(evidence.points.size()) / evidence.scale;
}

double MedianEdgeDepth(const EdgeEvidence& evidence) {
  std::vector<double> depths;
  for (const EdgePoint& point : evidence.points) depths.push_back(point.position.z());
  const auto middle = depths.begin() + static_cast<ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return *middle;
}

}  // namespace curvefusion
