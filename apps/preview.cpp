#include "apps/preview.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "apps/frame_overlay.h"
#include "capture/image_mat.h"
#include "experiments/pictures/orthographic_view.h"
#include "experiments/pictures/picture_style.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr int kPanelWidth = 790;
constexpr int kPanelHeight = 560;
constexpr int kGap = 10;
constexpr int kTitleHeight = 64;
constexpr int kFooterHeight = 40;
constexpr int kWidth = 2 * kPanelWidth + 3 * kGap;
constexpr int kHeight = kTitleHeight + 2 * kPanelHeight + 2 * kGap + kFooterHeight;
constexpr double kFilled = 0.76;          // share of a panel that the graph fills at most
constexpr double kSmallestExtent = 0.01;  // metres, so that a single point has a scale too

std::array<OrthographicView, 3> Views(const Mat3& front) {
  Mat3 side;
  Mat3 top;
  side << -front.row(2), front.row(1), front.row(0);
  top << front.row(0), -front.row(2), front.row(1);
  return {{{"front", front}, {"side", side}, {"top", top}}};
}

// Pixels per metre with which the graph fits into the panels of all views.
double CommonScale(const SkeletonGraph& graph, const std::array<OrthographicView, 3>& views) {
  double scale = kFilled * kPanelHeight / kSmallestExtent;
  for (const OrthographicView& view : views) {
    const Vec2 extent = ViewExtent(graph, view.R_view_world).cwiseMax(kSmallestExtent);
    scale =
        std::min({scale, kFilled * kPanelWidth / extent.x(), kFilled * kPanelHeight / extent.y()});
  }
  return scale;
}

void Paste(ColorImage panel, int index, cv::Mat& canvas) {
  const int x = kGap + (index % 2) * (kPanelWidth + kGap);
  const int y = kTitleHeight + (index / 2) * (kPanelHeight + kGap);
  const cv::Rect place(x, y, kPanelWidth, kPanelHeight);
  MatOf(panel).copyTo(canvas(place));
  cv::rectangle(canvas, place, {218, 220, 224}, 1);
}

// Text of smooth strokes: drawn large, then reduced.
void Text(cv::Mat& canvas, const std::string& text, const cv::Rect& place, double size,
          const Rgb& color) {
  cv::Mat large(place.height * kSupersampling, place.width * kSupersampling, CV_8UC3, Ink(kWhite));
  const cv::Point at(0, static_cast<int>(0.7 * large.rows));
  cv::putText(large, text, at, cv::FONT_HERSHEY_SIMPLEX, size * kSupersampling, Ink(color),
              kSupersampling, cv::LINE_AA);
  cv::resize(large, canvas(place), place.size(), 0, 0, cv::INTER_AREA);
}

// Points so close that they look like lines.
void AddPointsOf(const SkeletonGraph& graph, ObservedPoints& points) {
  constexpr double kStep = 0.0005;  // metres
  for (const EdgeId id : graph.Edges()) {
    for (const Vec3& p : Resample(graph.edge(id).points, kStep)) points.Add(p, Vec3::Zero(), 1);
  }
}

}  // namespace

Mat3 MeanCameraAxes(const Sequence& sequence) {
  Vec3 forward = Vec3::Zero();
  Vec3 down = Vec3::Zero();
  for (const SequenceFrame& frame : sequence.frames) {
    down += frame.T_world_camera.linear().col(1);
    forward += frame.T_world_camera.linear().col(2);
  }
  // Views from all around an object cancel out; then the first one decides.
  if (!sequence.frames.empty() && (forward.norm() < 1e-6 || down.cross(forward).norm() < 1e-6)) {
    forward = sequence.frames.front().T_world_camera.linear().col(2);
    down = sequence.frames.front().T_world_camera.linear().col(1);
  }
  if (forward.isZero()) return Mat3::Identity();
  const Vec3 up = -down.normalized();
  const Vec3 right = forward.cross(up).normalized();
  Mat3 axes;
  axes << right.transpose(), up.transpose(), right.cross(up).transpose();
  return axes;
}

ColorImage DrawPreview(const SkeletonGraph& graph, const SkeletonGraph& uncertain,
                       const ObservedPoints& points, const Sequence& sequence,
                       const std::string& title) {
  ColorImage preview(kWidth, kHeight, kWhite);
  cv::Mat canvas = MatOf(preview);
  const auto views = Views(MeanCameraAxes(sequence));
  const SkeletonGraph& shown = graph.empty() ? uncertain : graph;
  const double scale = CommonScale(shown, views);
  ObservedPoints grey = points;
  AddPointsOf(uncertain, grey);
  const int frame = FrameSeeingMost(shown, sequence);
  const auto draw_view = [&](const OrthographicView& view) {
    return DrawFramedView(graph, grey, view, ViewBounds(shown, view.R_view_world), kPanelWidth,
                          kPanelHeight, scale);
  };
  constexpr int kPanels = 4;
  ParallelFor(0, frame >= 0 ? kPanels : kPanels - 1, 1, [&](int64_t i) {
    const auto panel = static_cast<size_t>(i);
    Paste(panel < views.size()
              ? draw_view(views[panel])
              : DrawFrameOverlay(shown, sequence, frame, kPanelWidth, kPanelHeight,
                                 graph.empty() ? std::optional(kPaleInk) : std::nullopt),
          static_cast<int>(i), canvas);
  });
  const int text_width = kWidth - 4 * kGap;
  Text(canvas, title, {2 * kGap, 8, text_width, kTitleHeight - 16}, 0.85, kInk);
  const std::string footer = fmt::format(
      "filled dot: junction   ring: free end   grey: measured points, uncertain curves   lower "
      "right: frame {}",
      frame >= 0 ? sequence.frames[frame].name : "-");
  Text(canvas, footer, {2 * kGap, kHeight - kFooterHeight + 2, text_width, kFooterHeight - 8}, 0.5,
       kPaleInk);
  return preview;
}

}  // namespace curvefusion
