#include "apps/frame_overlay.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "capture/image_mat.h"
#include "experiments/pictures/picture_style.h"
#include "graph/sampled_curves.h"

namespace curvefusion {

namespace {

constexpr double kSampleStep = 0.005;  // metres between the samples that decide what is seen
constexpr double kAlmostAll = 0.98;    // of the best count of samples: as good as the best
constexpr double kMargin = 0.12;       // of the cut-out's size, around the graph
constexpr double kOpacity = 0.5;
constexpr int kShift = 4;

// How many samples a camera sees, and how large: the sum of 1/depth over them.
struct Visibility {
  int count = 0;
  double size = 0;
};

Visibility SeenBy(const PinholeCamera& camera, const RigidTransform& T_camera_world,
                  const Polyline& samples) {
  Visibility seen;
  for (const Vec3& sample : samples) {
    const Vec3 p_camera = T_camera_world * sample;
    if (p_camera.z() < PinholeCamera::kNearest || !camera.Contains(camera.Project(p_camera)))
      continue;
    ++seen.count;
    seen.size += 1 / p_camera.z();
  }
  return seen;
}

Eigen::AlignedBox2d ProjectedBounds(const Polyline& samples, const PinholeCamera& camera,
                                    const RigidTransform& T_camera_world) {
  Eigen::AlignedBox2d bounds;
  for (const Vec3& sample : samples) {
    const Vec3 p_camera = T_camera_world * sample;
    if (p_camera.z() < PinholeCamera::kNearest) continue;
    const Vec2 pixel = camera.Project(p_camera);
    if (camera.Contains(pixel)) bounds.extend(pixel);
  }
  if (bounds.isEmpty()) bounds = {Vec2::Zero(), Vec2(camera.width - 1, camera.height - 1)};
  return bounds;
}

// The part of an image, of the given ratio of width to height, that shows `bounds` with a margin.
// It may reach beyond the image.
cv::Rect2d CutOut(const Eigen::AlignedBox2d& bounds, double ratio) {
  const Vec2 size = bounds.sizes() * (1 + 2 * kMargin);
  const double width = std::max({size.x(), size.y() * ratio, 32.0});
  const Vec2 low = bounds.center() - Vec2(width, width / ratio) / 2;
  return {low.x(), low.y(), width, width / ratio};
}

// Maps pixels of the frame to pixels of the cut-out.
struct CutOutMap {
  double scale = 1;
  Vec2 origin = Vec2::Zero();

  Vec2 operator()(const Vec2& pixel) const { return scale * (pixel - origin); }
};

cv::Mat CutAndScale(const ColorImage& image, const CutOutMap& map, const cv::Size& size) {
  const cv::Mat source = MatOf(image);
  const cv::Matx23d affine(map.scale, 0, -map.scale * map.origin.x(),  //
                           0, map.scale, -map.scale * map.origin.y());
  cv::Mat result;
  cv::warpAffine(source, result, affine, size, cv::INTER_CUBIC, cv::BORDER_CONSTANT, Ink(kWhite));
  return result;
}

struct TubePainter {
  const PinholeCamera& camera;
  RigidTransform T_camera_world;
  CutOutMap map;

  // One stretch of tube: thickness follows radius and distance.
  void PaintSegment(cv::Mat& image, const SkeletonEdge& edge, size_t i, const Rgb& color,
                    int extra_px) const {
    const Vec3 a = T_camera_world * edge.points[i];
    const Vec3 b = T_camera_world * edge.points[i + 1];
    if (a.z() < PinholeCamera::kNearest || b.z() < PinholeCamera::kNearest) return;
    const double radius = edge.radii.empty() ? 0 : edge.radii[i];
    const double width_px = 2 * radius * camera.fx / a.z() * map.scale;
    const int thickness = std::max(kSupersampling, static_cast<int>(std::lround(width_px)));
    cv::line(image, Fixed(a), Fixed(b), Ink(color), thickness + extra_px, cv::LINE_AA, kShift);
  }

  void Paint(cv::Mat& image, const SkeletonEdge& edge, const Rgb& color, int extra_px) const {
    for (size_t i = 0; i + 1 < edge.points.size(); ++i) {
      PaintSegment(image, edge, i, color, extra_px);
    }
  }

  cv::Point Fixed(const Vec3& p_camera) const {
    const Vec2 pixel = map(camera.Project(p_camera));
    return {int(std::lround(std::ldexp(pixel.x(), kShift))),
            int(std::lround(std::ldexp(pixel.y(), kShift)))};
  }
};

void PaintTubes(const SkeletonGraph& graph, const TubePainter& painter,
                const std::optional<Rgb>& color, cv::Mat& image) {
  std::vector<std::pair<double, EdgeId>> by_depth;
  for (const EdgeId edge : graph.Edges()) {
    const Polyline& points = graph.edge(edge).points;
    by_depth.emplace_back(-(painter.T_camera_world * points[points.size() / 2]).z(), edge);
  }
  std::sort(by_depth.begin(), by_depth.end());
  cv::Mat painted = image.clone();
  for (const auto& [depth, edge] : by_depth) {
    painter.Paint(painted, graph.edge(edge), kWhite, 2 * kSupersampling);
    painter.Paint(painted, graph.edge(edge), color.value_or(EdgeColor(edge)), 0);
  }
  cv::addWeighted(painted, kOpacity, image, 1 - kOpacity, 0, image);
}

}  // namespace

int FrameSeeingMost(const SkeletonGraph& graph, const Sequence& sequence) {
  const std::vector<Vec3> samples = SampleCurvesOf(graph, kSampleStep).positions;
  std::vector<Visibility> seen;
  int most = 0;
  for (int frame = 0; frame < sequence.frame_count(); ++frame) {
    seen.push_back(SeenBy(sequence.color_camera, sequence.T_color_world(frame), samples));
    most = std::max(most, seen.back().count);
  }
  int best = -1;
  for (int frame = 0; frame < sequence.frame_count(); ++frame) {
    if (seen[frame].count < kAlmostAll * most) continue;
    if (best < 0 || seen[frame].size > seen[best].size) best = frame;
  }
  return best;
}

ColorImage DrawFrameOverlay(const SkeletonGraph& graph, const Sequence& sequence, int frame,
                            int width, int height, const std::optional<Rgb>& color) {
  const cv::Size size(width * kSupersampling, height * kSupersampling);
  const RigidTransform T_color_world = sequence.T_color_world(frame);
  const cv::Rect2d cut = CutOut(ProjectedBounds(SampleCurvesOf(graph, kSampleStep).positions,
                                                sequence.color_camera, T_color_world),
                                static_cast<double>(width) / height);
  const CutOutMap map{size.width / cut.width, {cut.x, cut.y}};
  cv::Mat image = CutAndScale(LoadColor(sequence, frame), map, size);
  PaintTubes(graph, {sequence.color_camera, T_color_world, map}, color, image);
  ColorImage result(width, height);
  cv::resize(image, MatOf(result), {width, height}, 0, 0, cv::INTER_AREA);
  return result;
}

}  // namespace curvefusion
