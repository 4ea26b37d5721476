#include "graph/graph_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace curvefusion {

namespace {

// What is wrong with radii or observation counts, given the least value that is no defect.
std::string ValuesDefect(const std::vector<double>& values, size_t point_count, const char* name,
                         bool zero_allowed) {
  if (!values.empty() && values.size() != point_count)
    return fmt::format("{} holds {} values for {} points", name, values.size(), point_count);
  const auto bad = std::find_if(values.begin(), values.end(), [zero_allowed](double value) {
    return !std::isfinite(value) || value < 0 || (value == 0 && !zero_allowed);
  });
  if (bad == values.end()) return "";
  return fmt::format("{}[{}] is {}, not {}", name, bad - values.begin(), *bad,
                     zero_allowed ? "a count" : "positive");
}

}  // namespace

std::string EdgeDefect(const SkeletonEdge& edge, const SkeletonGraph& graph) {
  const Polyline& points = edge.points;
  if (points.size() < 2)
    return fmt::format("points holds {} points, at least 2 needed", points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) return fmt::format("points[{}] is not finite", i);
    if (i > 0 && points[i] == points[i - 1])
      return fmt::format("points[{}] repeats the point before it", i);
  }
  if (points.front() != graph.position(edge.nodes[0]))
    return fmt::format("points does not have node {} as its first point", edge.nodes[0]);
  if (points.back() != graph.position(edge.nodes[1]))
    return fmt::format("points does not have node {} as its last point", edge.nodes[1]);
  const std::string radii = ValuesDefect(edge.radii, points.size(), "radii", false);
  if (!radii.empty()) return radii;
  return ValuesDefect(edge.observations, points.size(), "observations", true);
}

}  // namespace curvefusion
