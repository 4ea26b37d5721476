#include "fusion/nets/net_curves.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>
#include <utility>

#include "capture/image_mat.h"
#include "fusion/nets/line_tracing.h"
#include "fusion/nets/net_diameters.h"
#include "fusion/nets/net_sheets.h"
#include "fusion/nets/sheet_heights.h"
#include "fusion/nets/sheet_image.h"
#include "fusion/nets/sheet_views.h"
#include "graph/edge_parts.h"
#include "graph/intersections.h"
#include "kernel/camera.h"
#include "kernel/point_grid.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// All chosen on training scans chair 5, grid 5, mixture 3 and 5 and umbrella 5 (docs/nets.md).
constexpr double kMinSine = 0.43;      // of the angle at which lines cross: 25 degrees
constexpr size_t kMinCrossings = 3;    // of a wire
constexpr double kMaxSpacing = 0.05;   // metres of a wire for each that crosses it
constexpr double kHalfGap = 0.012;     // metres; gaps between wires are no wider than twice that
constexpr double kSameCosine = 0.85;   // of the angle between curves that are one wire
constexpr double kOnSheet = 0.006;     // metres
constexpr double kOvershoot = 0.005;   // metres: by which lines go on beyond those they end at
constexpr double kMeet = 0.0015;       // metres between wires that cross on one sheet
constexpr double kPointStep = 0.0018;  // metres
constexpr int kSmoothing = 3;          // rounds: 2 pixels along a line

size_t PointStride() { return static_cast<size_t>(std::lround(kPointStep / SheetImage::kStep)); }

// Calls visit(u, v) for the pixels of a line that lie in an image.
template <class Pixel, class Visit>
void ForEachPixel(const ImageLine& line, const Image<Pixel>& image, const Visit& visit) {
  for (size_t i = 0; i < line.size(); ++i) {
    const Eigen::Vector2i at = PinholeCamera::Rounded(line[i]);
    if (image.Contains(at.x(), at.y())) visit(i, at.x(), at.y());
  }
}

// The numbers of the lines that cross each line.
std::vector<std::set<size_t>> CrossingLines(const std::vector<ImageLine>& lines, int width,
                                            int height) {
  using Passing = std::pair<size_t, double>;  // number of a line, and its angle
  Image<std::vector<Passing>> passing(width, height);
  for (size_t n = 0; n < lines.size(); ++n) {
    ForEachPixel(lines[n], passing, [&](size_t i, int u, int v) {
      passing(u, v).emplace_back(n, AngleAt(lines[n], i));
    });
  }
  std::vector<std::set<size_t>> crossing(lines.size());
  for (size_t n = 0; n < lines.size(); ++n) {
    ForEachPixel(lines[n], passing, [&](size_t i, int u, int v) {
      const double angle = AngleAt(lines[n], i);
      for (int k = 0; k < 9; ++k) {
        const int x = u + k % 3 - 1, y = v + k / 3 - 1;
        if (!passing.Contains(x, y)) continue;
        for (const auto& [other, other_angle] : passing(x, y))
          if (other != n && std::abs(std::sin(other_angle - angle)) > kMinSine)
            crossing[n].insert(other);
      }
    });
  }
  return crossing;
}

// A wire of a net crosses others of it again and again; what looks like a line elsewhere does not.
std::vector<ImageLine> ThoseOfNet(std::vector<ImageLine> lines, int width, int height) {
  std::vector<std::set<size_t>> crossing = CrossingLines(lines, width, height);
  std::set<size_t> gone;
  for (size_t before = 1; gone.size() != before;) {
    before = gone.size();
    for (size_t n = 0; n < lines.size(); ++n) {
      const double length = SheetImage::kStep * static_cast<double>(lines[n].size());
      const bool is_wire = crossing[n].size() >= kMinCrossings &&
                           length <= kMaxSpacing * static_cast<double>(crossing[n].size());
      if (is_wire || !gone.insert(n).second) continue;
      for (const size_t other : crossing[n]) crossing[other].erase(n);
    }
  }
  std::vector<ImageLine> kept;
  for (size_t n = 0; n < lines.size(); ++n)
    if (!gone.contains(n)) kept.push_back(std::move(lines[n]));
  return kept;
}

// 1 on the lines and between them.
MaskImage Between(const std::vector<ImageLine>& lines, int width, int height) {
  MaskImage between(width, height, 0);
  for (const ImageLine& line : lines)
    ForEachPixel(line, between, [&](size_t, int u, int v) { between(u, v) = 1; });
  const int reach = static_cast<int>(kHalfGap / SheetImage::kStep);
  cv::Mat pixels = MatOf(between);
  cv::morphologyEx(pixels, pixels, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1}));
  return between;
}

Polyline Lifted(const NetSheet& sheet, ImageLine line) {
  for (int round = 0; round < kSmoothing; ++round)
    for (size_t i = 1; i + 1 < line.size(); ++i)
      line[i] = 0.25 * line[i - 1] + 0.5 * line[i] + 0.25 * line[i + 1];
  Polyline points;
  const auto lift = [&](const Vec2& p) {
    points.push_back(sheet.At(SheetImage::kStep * p.x(), SheetImage::kStep * p.y()));
  };
  for (size_t i = 0; i + 1 < line.size(); i += PointStride()) lift(line[i]);
  lift(line.back());
  return points;
}

// The wires of a net on a sheet.
struct WiresOfSheet {
  NetSheet sheet;
  MaskImage between;  // in pixels of SheetImage
  std::vector<NetWire> wires;

  // Whether a place lies on the sheet between the wires.
  bool Holds(const Vec3& p) const {
    const Vec3 q = sheet.axes.transpose() * (p - sheet.origin);
    const int u = static_cast<int>(std::lround(q.x() / SheetImage::kStep));
    const int v = static_cast<int>(std::lround(q.y() / SheetImage::kStep));
    return between.Contains(u, v) && between(u, v) && std::abs(sheet.Above(p)) < kOnSheet;
  }
};

// Wires that no image shows well enough are as thick as the others.
void FillDiameters(std::vector<NetWire>& wires) {
  std::vector<double> measured;
  for (const NetWire& wire : wires)
    if (wire.diameter > 0) measured.push_back(wire.diameter);
  if (measured.empty()) return;
  const double usual = Median(std::move(measured));
  for (NetWire& wire : wires)
    if (wire.diameter == 0) wire.diameter = usual;
}

WiresOfSheet FindWires(const Sequence& sequence, const SkeletonGraph& skeleton, double noise,
                       NetSheet sheet) {
  const std::vector<SheetView> views = ViewsOfSheet(sequence, skeleton, sheet);
  MoveToWhereImagesAgree(sequence, views, sheet);
  const SheetPixels pixels(sheet, SheetImage::kStep);
  const std::vector<SheetLook> looks = LookAt(sequence, views, pixels, Vec3::Zero());
  const SheetImage image = WiresOnSheet(ColoursOf(looks, pixels.known), pixels.known, noise);
  const int width = image.wire.width(), height = image.wire.height();
  const std::vector<ImageLine> lines =
      ThoseOfNet(TraceLines(image.wire, image.known, SheetImage::kStep), width, height);
  WiresOfSheet found = {sheet, Between(lines, width, height), {}};
  for (const ImageLine& line : lines) {
    found.wires.push_back(
        {Lifted(sheet, line), DiameterOfLine(line, sheet, SheetImage::kStep, views, looks,
                                             sequence.color_camera, noise)});
  }
  FillDiameters(found.wires);
  return found;
}

// What runs along the wires, or lies between them on their sheet.
void RemoveReplaced(const WiresOfSheet& found, SkeletonGraph& skeleton) {
  std::vector<Vec3> places, directions;
  for (const NetWire& wire : found.wires) {
    const std::vector<Vec3> tangents = Tangents(wire.points);
    places.insert(places.end(), wire.points.begin(), wire.points.end());
    directions.insert(directions.end(), tangents.begin(), tangents.end());
  }
  const PointGrid wires(places, kSameWire);
  for (const EdgeId id : skeleton.Edges()) {
    const Polyline points = skeleton.edge(id).points;
    const std::vector<Vec3> tangents = Tangents(points);
    const std::vector<EdgePart> parts = PartsWhere(points.size(), [&](size_t i) {
      bool is_replaced = found.Holds(points[i]);
      wires.ForEachWithin(points[i], kSameWire, [&](int near, const Vec3&) {
        is_replaced |= std::abs(directions[near].dot(tangents[i])) > kSameCosine;
      });
      return !is_replaced;
    });
    const bool is_whole = !parts.empty() && PointCount(parts[0]) == points.size();
    if (!is_whole) KeepParts(id, parts, kMinPiece, skeleton);
  }
  skeleton.RemoveIsolatedNodes();
}

void DropOvershoot(SkeletonGraph& skeleton) {
  for (const EdgeId id : skeleton.Edges()) {
    const SkeletonEdge& edge = skeleton.edge(id);
    const int first = skeleton.Degree(edge.nodes[0]), last = skeleton.Degree(edge.nodes[1]);
    if (std::min(first, last) == 1 && std::max(first, last) > 2 && Length(edge.points) < kOvershoot)
      skeleton.RemoveEdge(id);
  }
  skeleton.RemoveIsolatedNodes();
  skeleton.DissolveDegree2Nodes();
}

}  // namespace

NetCurves AddNetCurves(const Sequence& sequence, const Nets& nets, double radius,
                       SkeletonGraph& skeleton) {
  NetCurves curves;
  const double before = skeleton.TotalLength();
  for (NetSheet& sheet : SheetsOf(sequence, nets)) {
    const WiresOfSheet found = FindWires(sequence, skeleton, nets.noise, std::move(sheet));
    if (found.wires.empty()) continue;
    RemoveReplaced(found, skeleton);
    curves.wires.insert(curves.wires.end(), found.wires.begin(), found.wires.end());
  }
  if (curves.wires.empty()) return curves;
  curves.replaced = before - skeleton.TotalLength();
  for (const NetWire& wire : curves.wires) {
    const double own = wire.diameter > 0 ? 0.5 * wire.diameter : radius;
    skeleton.SetCurve(skeleton.AddPolyline(wire.points), wire.points,
                      std::vector<double>(wire.points.size(), own));
    curves.length += Length(wire.points);
  }
  ResolveIntersections(skeleton, kMeet);
  DropOvershoot(skeleton);
  return curves;
}

}  // namespace curvefusion
