#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "graph/io/graph_formats.h"
#include "kernel/atomic_file.h"

namespace curvefusion {

namespace {

using Vec4 = Eigen::Vector4d;  // position and radius

// Curves one after the other, as a BasisCurves prim has them.
struct Curves {
  std::vector<size_t> counts;
  std::vector<Vec4> points;
};

template <class Values, class Format>
std::string List(const Values& values, const Format& format) {
  std::string text = "[";
  for (const auto& value : values) {
    if (text.size() > 1) text += ", ";
    text += format(value);
  }
  return text + "]";
}

std::string Text(const Curves& curves, const std::string& type) {
  Eigen::AlignedBox3d extent;
  for (const Vec4& p : curves.points) {
    extent.extend(Vec3(p.head<3>().array() - p[3]));
    extent.extend(Vec3(p.head<3>().array() + p[3]));
  }
  if (extent.isEmpty()) extent.extend(Vec3(0, 0, 0));
  const auto point = [](const auto& p) {
    return fmt::format("({:.9g}, {:.9g}, {:.9g})", p[0], p[1], p[2]);
  };
  const bool has_widths = std::any_of(curves.points.begin(), curves.points.end(),
                                      [](const Vec4& p) { return p[3] > 0; });
  std::string text =
      "#usda 1.0\n(\n    defaultPrim = \"wires\"\n    metersPerUnit = 1\n)\n\n"
      "def BasisCurves \"wires\"\n{\n" +
      type + "    uniform token wrap = \"nonperiodic\"\n";
  text += "    int[] curveVertexCounts = " +
          List(curves.counts, [](size_t count) { return std::to_string(count); }) + "\n";
  text += "    float3[] extent = [" + point(extent.min()) + ", " + point(extent.max()) + "]\n";
  text += "    point3f[] points = " + List(curves.points, point) + "\n";
  if (has_widths) {
    const auto width = [](const Vec4& p) { return fmt::format("{:.9g}", 2 * p[3]); };
    text += "    float[] widths = " + List(curves.points, width) +
            " (\n        interpolation = \"vertex\"\n    )\n";
  }
  return text + "}\n";
}

void Write(const std::filesystem::path& path, const std::string& text) {
  WriteBytesAtomically(path, text);
}

}  // namespace

FormatLosses WriteUsda(const std::filesystem::path& path, const SkeletonGraph& graph) {
  Curves curves;
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    curves.counts.push_back(edge.points.size());
    for (size_t i = 0; i < edge.points.size(); ++i) {
      const Vec3& p = edge.points[i];
      curves.points.emplace_back(p.x(), p.y(), p.z(), edge.radii.empty() ? 0 : edge.radii[i]);
    }
  }
  Write(path, Text(curves, "    uniform token type = \"linear\"\n"));
  return LossesOfCurves(graph, true);
}

void WriteUsdaSplines(const std::filesystem::path& path, const FittedCurves& fitted) {
  Curves curves;
  for (const auto& [edge, spline] : fitted) {
    const std::vector<Vec4> bezier = BezierPoints(spline);
    curves.counts.push_back(bezier.size());
    curves.points.insert(curves.points.end(), bezier.begin(), bezier.end());
  }
  Write(path,
        Text(curves, "    uniform token type = \"cubic\"\n    uniform token basis = \"bezier\"\n"));
}

}  // namespace curvefusion
