#include "experiments/pictures/orthographic_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "capture/image_mat.h"
#include "experiments/pictures/picture_style.h"

namespace curvefusion {

namespace {

constexpr int kShift = 4;                // fractional bits of drawing coordinates
constexpr double kHaloShare = 0.9;       // width of the white halo, relative to the line's
constexpr double kScaleBarShare = 0.22;  // of the panel's width, at most
constexpr size_t kMostDots = 100000;

// Draws at kSupersampling times the size of the picture that comes out.
class Panel {
 public:
  Panel(const Eigen::AlignedBox3d& bounds, const OrthographicView& view, int width, int height,
        double scale)
      : view_(view),
        scale_(scale * kSupersampling),
        bounds_(bounds),
        image_(height * kSupersampling, width * kSupersampling, CV_8UC3, Ink(kWhite)) {}

  void DrawPoints(const ObservedPoints& points) {
    const size_t stride = points.size() / kMostDots + 1;
    std::vector<Vec3> dots;
    for (size_t i = 0; i < points.size(); i += stride) {
      dots.push_back(view_.R_view_world * points.positions[i]);
    }
    std::sort(dots.begin(), dots.end(), [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
    for (const Vec3& dot : dots) {
      const double shade = (1 - view_.point_ink) * (232 - 90 * Nearness(dot.z()));
      cv::circle(image_, Fixed(dot), 1 << kShift, {shade, shade, shade}, cv::FILLED, cv::LINE_AA,
                 kShift);
    }
  }

  void DrawGraph(const SkeletonGraph& graph) {
    std::vector<std::pair<double, EdgeId>> by_depth;
    for (const EdgeId edge : graph.Edges()) {
      double sum = 0;
      for (const Vec3& p : graph.edge(edge).points) sum += (view_.R_view_world * p).z();
      by_depth.emplace_back(sum / static_cast<double>(graph.edge(edge).points.size()), edge);
    }
    std::sort(by_depth.begin(), by_depth.end());
    for (const auto& [depth, edge] : by_depth) {
      const int thickness = kSupersampling * (Nearness(depth) > 0.5 ? 3 : 2);
      DrawCurve(graph.edge(edge).points, kWhite, thickness + int(kHaloShare * thickness));
      DrawCurve(graph.edge(edge).points, EdgeColor(edge), thickness);
    }
    for (const NodeId node : graph.Nodes()) DrawNode(graph.position(node), graph.Degree(node));
  }

  void DrawScaleBar() {
    const double widest = kScaleBarShare * image_.cols / scale_;
    double length = std::pow(10, std::floor(std::log10(widest)));
    for (const double factor : {5.0, 2.0}) {
      if (factor * length > widest) continue;
      length *= factor;
      break;
    }
    const int x = 24 * kSupersampling;
    const int y = image_.rows - 24 * kSupersampling;
    const int end = x + static_cast<int>(length * scale_);
    const int tick = 5 * kSupersampling;
    const int line = 2 * kSupersampling;
    cv::line(image_, {x, y}, {end, y}, Ink(kInk), line, cv::LINE_AA);
    cv::line(image_, {x, y - tick}, {x, y + tick}, Ink(kInk), line, cv::LINE_AA);
    cv::line(image_, {end, y - tick}, {end, y + tick}, Ink(kInk), line, cv::LINE_AA);
    Text(fmt::format("{:g} mm", length / kMillimetre), {x, y - 12 * kSupersampling}, 0.5, kInk);
  }

  void DrawName() { Text(view_.name, {24 * kSupersampling, 36 * kSupersampling}, 0.7, kPaleInk); }

  ColorImage Reduced() const {
    ColorImage result(image_.cols / kSupersampling, image_.rows / kSupersampling);
    cv::resize(image_, MatOf(result), {result.width(), result.height()}, 0, 0, cv::INTER_AREA);
    return result;
  }

 private:
  // 0 at the far side of the graph, 1 at the near one.
  double Nearness(double z) const {
    const double depth = bounds_.sizes().z();
    return depth > 0 ? std::clamp((z - bounds_.min().z()) / depth, 0.0, 1.0) : 1;
  }

  cv::Point Fixed(const Vec3& p_view) const {
    const Vec3 offset = p_view - bounds_.center();
    const double x = image_.cols / 2. + scale_ * offset.x();
    const double y = image_.rows / 2. - scale_ * offset.y();
    return {int(std::lround(std::ldexp(x, kShift))), int(std::lround(std::ldexp(y, kShift)))};
  }

  void DrawCurve(const Polyline& points, const Rgb& color, int thickness) {
    std::vector<cv::Point> pixels;
    for (const Vec3& p : points) pixels.push_back(Fixed(view_.R_view_world * p));
    cv::polylines(image_, pixels, false, Ink(color), thickness, cv::LINE_AA, kShift);
  }

  void DrawNode(const Vec3& position, int degree) {
    if (degree == 0 || degree == 2) return;
    const cv::Point centre = Fixed(view_.R_view_world * position);
    const int radius = (degree == 1 ? 4 : 5) * kSupersampling << kShift;
    const int ring = kSupersampling << kShift;
    cv::circle(image_, centre, radius + ring, Ink(kWhite), cv::FILLED, cv::LINE_AA, kShift);
    cv::circle(image_, centre, radius, Ink(kInk), cv::FILLED, cv::LINE_AA, kShift);
    if (degree > 1) return;
    cv::circle(image_, centre, radius - 3 * ring / 2, Ink(kWhite), cv::FILLED, cv::LINE_AA, kShift);
  }

  void Text(const std::string& text, const cv::Point& at, double size, const Rgb& color) {
    cv::putText(image_, text, at, cv::FONT_HERSHEY_SIMPLEX, size * kSupersampling, Ink(color),
                kSupersampling, cv::LINE_AA);
  }

  const OrthographicView& view_;
  double scale_;
  Eigen::AlignedBox3d bounds_;
  cv::Mat image_;
};

}  // namespace

Eigen::AlignedBox3d ViewBounds(const SkeletonGraph& graph, const Mat3& R_view_world) {
  Eigen::AlignedBox3d bounds;
  for (const EdgeId edge : graph.Edges()) {
    for (const Vec3& p : graph.edge(edge).points) bounds.extend(R_view_world * p);
  }
  return bounds;
}

Vec2 ViewExtent(const SkeletonGraph& graph, const Mat3& R_view_world) {
  const Eigen::AlignedBox3d bounds = ViewBounds(graph, R_view_world);
  return bounds.isEmpty() ? Vec2::Zero() : Vec2(bounds.sizes().head<2>());
}

ColorImage DrawFramedView(const SkeletonGraph& graph, const ObservedPoints& points,
                          const OrthographicView& view, const Eigen::AlignedBox3d& bounds,
                          int width, int height, double scale) {
  Panel panel(bounds, view, width, height, scale);
  panel.DrawPoints(points);
  panel.DrawGraph(graph);
  if (view.scale_bar) panel.DrawScaleBar();
  panel.DrawName();
  return panel.Reduced();
}

}  // namespace curvefusion
