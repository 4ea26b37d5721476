#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "graph/graph_figures.h"
#include "graph/io/graph_formats.h"
#include "kernel/atomic_file.h"

namespace curvefusion {

namespace {

// All in millimetres of paper, which are those of the object. Chosen: dimension lines as drawings
// have them, that do not touch.
constexpr double kMargin = 12;
constexpr double kGap = 24;
constexpr double kLineOffset = 6;    // from a view to its dimension line
constexpr double kTick = 1.5;        // half the length of its ends
constexpr double kUnknownWidth = 1;  // of curves without a diameter
constexpr double kMinTextSize = 4;
constexpr double kTextShare = 0.03;  // of the object's largest side

// Two axes of the file, and where the view stands on the page.
struct View {
  const char* name;
  int right;
  int down;
  double x;
  double y;
};

class SvgText {
 public:
  SvgText(const SkeletonGraph& graph, const GraphFigures& figures) : graph_(graph) {
    const std::vector<EdgeId> edges = graph.Edges();
    for (size_t i = 0; i < edges.size(); ++i) {
      const double diameter = 2 * figures.edge_radius[i] / kMillimetre;
      widths_.push_back(diameter > 0 ? diameter : kUnknownWidth);
      for (const Vec3& p : graph.edge(edges[i]).points) {
        box_.extend(Vec3(p / kMillimetre + Vec3::Constant(widths_.back() / 2)));
        box_.extend(Vec3(p / kMillimetre - Vec3::Constant(widths_.back() / 2)));
      }
    }
    if (edges.empty()) box_.extend(Vec3(0, 0, 0));
    size_ = box_.sizes();
    text_size_ = std::max(kMinTextSize, kTextShare * size_.maxCoeff());
  }

  std::string Text() {
    const double left = kMargin + kLineOffset + text_size_;
    const double top = kMargin + text_size_;
    const double side = left + size_.x() + kGap + text_size_;
    const double below = top + size_.y() + kGap + 2 * text_size_;
    AddView({"front", 0, 1, left, top});
    AddView({"side", 2, 1, side, top});
    AddView({"top", 0, 2, left, below});
    AddHorizontal(left, top + size_.y(), size_.x());
    AddHorizontal(side, top + size_.y(), size_.z());
    AddVertical(left, top, size_.y());
    AddVertical(left, below, size_.z());
    const double width = side + size_.z() + kMargin;
    const double height = below + size_.z() + kMargin;
    return fmt::format(
               "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.3f}mm\" "
               "height=\"{1:.3f}mm\" viewBox=\"0 0 {0:.3f} {1:.3f}\" font-family=\"sans-serif\" "
               "font-size=\"{2:.3f}\">\n",
               width, height, text_size_) +
           text_ + "</svg>\n";
  }

 private:
  void AddView(const View& view) {
    text_ += fmt::format(
        "<g id=\"{}\" fill=\"none\" stroke=\"black\" stroke-linecap=\"round\" "
        "stroke-linejoin=\"round\">\n<text x=\"{:.3f}\" y=\"{:.3f}\" fill=\"black\" "
        "stroke=\"none\">{}</text>\n",
        view.name, view.x, view.y - text_size_ / 2, view.name);
    const std::vector<EdgeId> edges = graph_.Edges();
    for (size_t i = 0; i < edges.size(); ++i) {
      text_ += fmt::format("<polyline id=\"{}-{}\" stroke-width=\"{:.3f}\" points=\"", view.name,
                           edges[i], widths_[i]);
      const char* separator = "";
      for (const Vec3& p : graph_.edge(edges[i]).points) {
        const Vec3 mm = p / kMillimetre - box_.min();
        text_ += fmt::format("{}{:.3f},{:.3f}", separator, view.x + mm[view.right],
                             view.y + mm[view.down]);
        separator = " ";
      }
      text_ += "\"/>\n";
    }
    text_ += "</g>\n";
  }

  void AddLine(double x1, double y1, double x2, double y2) {
    text_ += fmt::format(
        "<line x1=\"{:.3f}\" y1=\"{:.3f}\" x2=\"{:.3f}\" y2=\"{:.3f}\" stroke=\"black\" "
        "stroke-width=\"0.25\"/>\n",
        x1, y1, x2, y2);
  }

  void AddHorizontal(double x, double bottom, double length) {
    const double y = bottom + kLineOffset;
    AddLine(x, y, x + length, y);
    AddLine(x, y - kTick, x, y + kTick);
    AddLine(x + length, y - kTick, x + length, y + kTick);
    text_ +=
        fmt::format("<text x=\"{:.3f}\" y=\"{:.3f}\" text-anchor=\"middle\">{:.1f} mm</text>\n",
                    x + length / 2, y + text_size_ + 1, length);
  }

  void AddVertical(double left, double y, double length) {
    const double x = left - kLineOffset;
    AddLine(x, y, x, y + length);
    AddLine(x - kTick, y, x + kTick, y);
    AddLine(x - kTick, y + length, x + kTick, y + length);
    const double middle = y + length / 2;
    text_ += fmt::format(
        "<text x=\"{0:.3f}\" y=\"{1:.3f}\" text-anchor=\"middle\" transform=\"rotate(-90 {0:.3f} "
        "{1:.3f})\">{2:.1f} mm</text>\n",
        x - 2, middle, length);
  }

  const SkeletonGraph& graph_;
  std::vector<double> widths_;  // of the edges
  Eigen::AlignedBox3d box_;
  Vec3 size_ = Vec3::Zero();
  double text_size_ = kMinTextSize;
  std::string text_;
};

}  // namespace

FormatLosses WriteSvg(const std::filesystem::path& path, const SkeletonGraph& graph) {
  const std::string text = SvgText(graph, MeasureGraph(graph)).Text();
  WriteBytesAtomically(path, text);
  FormatLosses losses = LossesOfCurves(graph, true);
  if (graph.edge_count() > 0) losses.emplace_back("three views; curves have one width each");
  return losses;
}

}  // namespace curvefusion
