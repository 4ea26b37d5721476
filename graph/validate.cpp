#include "graph/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "graph/contacts.h"
#include "graph/parallel_edges.h"
#include "kernel/bounds.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

constexpr size_t kListedViolations = 5;  // chosen: what a message has room for
constexpr const char* kNotComputable = "is not finite, or too far from the origin to compute with";

// The first point that is not within bounds, or the end.
Polyline::const_iterator OutOfBounds(const Polyline& points, double limit) {
  return std::find_if_not(points.begin(), points.end(),
                          [limit](const Vec3& p) { return IsWithinBounds(p, limit); });
}

// What is wrong with points, the first place of each kind.
void AddPointFaults(const SkeletonEdge& edge, const SkeletonGraph& graph,
                    std::vector<std::string>& faults) {
  const Polyline& points = edge.points;
  const auto outside = OutOfBounds(points, kMaxComputable);
  if (outside != points.end())
    faults.push_back(fmt::format("points[{}] {}", outside - points.begin(), kNotComputable));
  const auto repeated = std::adjacent_find(points.begin(), points.end());
  if (repeated != points.end())
    faults.push_back(
        fmt::format("points[{}] repeats the point before it", repeated - points.begin() + 1));
  if (points.front() != graph.position(edge.nodes[0]))
    faults.push_back(fmt::format("points does not have node {} as its first point", edge.nodes[0]));
  if (points.back() != graph.position(edge.nodes[1]))
    faults.push_back(fmt::format("points does not have node {} as its last point", edge.nodes[1]));
}

// What is wrong with radii or observation counts.
void AddValueFaults(const std::vector<double>& values, size_t point_count, const char* name,
                    bool zero_allowed, std::vector<std::string>& faults) {
  if (!values.empty() && values.size() != point_count)
    faults.push_back(
        fmt::format("{} holds {} values for {} points", name, values.size(), point_count));
  const auto bad = std::find_if(values.begin(), values.end(), [zero_allowed](double value) {
    return !std::isfinite(value) || value < 0 || (value == 0 && !zero_allowed);
  });
  if (bad != values.end())
    faults.push_back(fmt::format("{}[{}] is {}, not {}", name, bad - values.begin(), *bad,
                                 zero_allowed ? "a count" : "positive"));
}

void AddContacts(const SkeletonGraph& graph, double proximity,
                 std::vector<std::string>& violations) {
  for (const Contact& contact : FindContacts(graph, proximity)) {
    const auto& [a, b] = contact.closest;
    violations.push_back(fmt::format(
        "edge {} at {:.6g} m comes within {:.3g} mm of edge {} at {:.6g} m, limit {:.3g} mm",
        a.edge, a.arc_length, contact.distance / kMillimetre, b.edge, b.arc_length,
        proximity / kMillimetre));
  }
}

}  // namespace

std::vector<std::string> EdgeFaults(const SkeletonEdge& edge, const SkeletonGraph& graph) {
  if (edge.points.size() < 2)
    return {fmt::format("points holds {} points, at least 2 needed", edge.points.size())};
  std::vector<std::string> faults;
  AddPointFaults(edge, graph, faults);
  AddValueFaults(edge.radii, edge.points.size(), "radii", false, faults);
  AddValueFaults(edge.observations, edge.points.size(), "observations", true, faults);
  return faults;
}

std::vector<std::string> Faults(const SkeletonGraph& graph) {
  std::vector<std::string> violations;
  for (const NodeId node : graph.Nodes())
    if (!IsWithinBounds(graph.position(node), kMaxComputable))
      violations.push_back(fmt::format("node {} {}", node, kNotComputable));
  for (const EdgeId id : graph.Edges())
    for (const std::string& fault : EdgeFaults(graph.edge(id), graph))
      violations.push_back(fmt::format("edge {}: {}", id, fault));
  return violations;
}

std::vector<std::string> Violations(const SkeletonGraph& graph, double proximity) {
  std::vector<std::string> violations = Faults(graph);
  // Distances mean nothing where coordinates do not.
  if (!violations.empty()) return violations;
  AddContacts(graph, proximity, violations);
  for (const auto& [a, b] : ParallelEdges(graph, proximity))
    violations.push_back(fmt::format("edges {} and {} are the same curve", a, b));
  return violations;
}

void Validate(const SkeletonGraph& graph, double proximity, const std::string& subject) {
  const std::vector<std::string> violations = Violations(graph, proximity);
  if (violations.empty()) return;
  std::string text = fmt::format("{} is not valid ({} violations):", subject, violations.size());
  for (size_t i = 0; i < std::min(kListedViolations, violations.size()); ++i)
    text += "\n  " + violations[i];
  throw Error(ErrorKind::kBadInput, text);
}

void RequireComputable(const SkeletonGraph& graph, const std::string& subject) {
  for (const EdgeId id : graph.Edges()) {
    const Polyline& points = graph.edge(id).points;
    const auto outside = OutOfBounds(points, kMaxComputable);
    if (outside == points.end()) continue;
    throw Error(ErrorKind::kBadInput, fmt::format("{}: edge {}: points[{}] {}", subject, id,
                                                  outside - points.begin(), kNotComputable));
  }
}

void RequireWithinBounds(const SkeletonGraph& graph, const std::string& subject) {
  const auto fail = [&](const std::string& what) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: {} more than 10,000 km; move the curves near the origin, or "
                            "correct the value",
                            subject, what));
  };
  for (const NodeId node : graph.Nodes())
    if (!IsWithinBounds(graph.position(node), kMaxCoordinate))
      fail(fmt::format("node {} is away from the origin by", node));
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    const auto outside = OutOfBounds(edge.points, kMaxCoordinate);
    if (outside != edge.points.end())
      fail(fmt::format("edge {}: points[{}] is away from the origin by", id,
                       outside - edge.points.begin()));
    const auto wide = std::find_if(edge.radii.begin(), edge.radii.end(),
                                   [](double radius) { return !(radius <= kMaxCoordinate); });
    if (wide != edge.radii.end())
      fail(fmt::format("edge {}: radii[{}] is", id, wide - edge.radii.begin()));
  }
}

void RequireLength(const SkeletonGraph& graph, double limit, const std::string& subject) {
  const double length = graph.TotalLength();
  if (length <= limit) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: has {:.6g} m of curves, the limit is {:g} m; are its coordinates in "
                          "metres?",
                          subject, length, limit));
}

}  // namespace curvefusion
