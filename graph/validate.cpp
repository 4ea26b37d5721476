#include "graph/validate.h"

#include <fmt/format.h>

#include <algorithm>

#include "graph/contacts.h"
#include "graph/merge.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

constexpr size_t kListedViolations = 5;

bool HasInvalidValue(const std::vector<double>& values, bool zero_allowed) {
  return std::any_of(values.begin(), values.end(), [zero_allowed](double value) {
    return !std::isfinite(value) || value < 0 || (value == 0 && !zero_allowed);
  });
}

bool AllFinite(const Polyline& points) {
  return std::all_of(points.begin(), points.end(), [](const Vec3& p) { return p.allFinite(); });
}

bool IsPerPoint(const std::vector<double>& values, const Polyline& points) {
  return values.empty() || values.size() == points.size();
}

// Violations of one edge by itself, each the end of a sentence about it.
std::vector<std::string> EdgeFaults(const SkeletonGraph& graph, const SkeletonEdge& edge) {
  std::vector<std::string> faults;
  if (edge.points.size() < 2) return {"has fewer than two points"};
  if (!AllFinite(edge.points)) faults.push_back("has a coordinate that is not finite");
  if (edge.points.front() != graph.position(edge.nodes[0]) ||
      edge.points.back() != graph.position(edge.nodes[1]))
    faults.push_back("does not end in its nodes");
  const auto repeated = std::adjacent_find(edge.points.begin(), edge.points.end());
  if (repeated != edge.points.end())
    faults.push_back(
        fmt::format("has a segment of length zero at point {}", repeated - edge.points.begin()));
  if (!IsPerPoint(edge.radii, edge.points) || !IsPerPoint(edge.observations, edge.points))
    faults.push_back("does not have one radius and one observation count per point");
  if (HasInvalidValue(edge.radii, false)) faults.push_back("has a radius that is not positive");
  if (HasInvalidValue(edge.observations, true))
    faults.push_back("has an observation count that is negative");
  return faults;
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

std::vector<std::string> Faults(const SkeletonGraph& graph) {
  std::vector<std::string> violations;
  for (const NodeId node : graph.Nodes())
    if (!graph.position(node).allFinite())
      violations.push_back(fmt::format("node {} has a coordinate that is not finite", node));
  for (const EdgeId id : graph.Edges())
    for (const std::string& fault : EdgeFaults(graph, graph.edge(id)))
      violations.push_back(fmt::format("edge {} {}", id, fault));
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

void RequireFinite(const SkeletonGraph& graph, const std::string& subject) {
  for (const EdgeId id : graph.Edges())
    if (!AllFinite(graph.edge(id).points))
      throw Error(ErrorKind::kBadInput,
                  fmt::format("{}: edge {} has a coordinate that is not finite", subject, id));
}

}  // namespace curvefusion
