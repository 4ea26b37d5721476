#include "experiments/simulation/object_truth.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "kernel/atomic_file.h"
#include "kernel/error.h"
#include "kernel/spatial_search.h"

namespace curvefusion {
namespace {

constexpr double kContactDistance = 1.2e-3;  // centre lines this near are welded
constexpr double kContactCluster = 4e-3;     // contacts this near are one junction
constexpr double kSampleStep = 1e-3;
constexpr double kEndReach = 3e-3;  // a contact this near to a wire's end is its end

struct CurveSamples {
  std::vector<Vec3> positions;
  std::vector<int> curve;
};

CurveSamples SampleCurves(const WireObject& object) {
  CurveSamples samples;
  for (size_t i = 0; i < object.curves.size(); ++i) {
    for (const Vec3& p : Resample(object.curves[i].points, kSampleStep)) {
      samples.positions.push_back(p);
      samples.curve.push_back(static_cast<int>(i));
    }
  }
  return samples;
}

// A place where wires meet, and which.
struct Contact {
  Vec3 position = Vec3::Zero();
  std::vector<int> curves;  // ascending
};

// Midpoints between samples of different curves within the contact distance; each pair once.
void FindTouches(const CurveSamples& samples, std::vector<Vec3>& midpoints,
                 std::vector<std::pair<int, int>>& curves) {
  const PointIndex index(samples.positions);
  std::vector<int> found;
  for (int i = 0; i < static_cast<int>(samples.positions.size()); ++i) {
    index.WithinRadius(samples.positions[i], kContactDistance, found);
    for (const int j : found) {
      if (j <= i || samples.curve[i] == samples.curve[j]) continue;
      midpoints.push_back((samples.positions[i] + samples.positions[j]) / 2);
      curves.emplace_back(samples.curve[i], samples.curve[j]);
    }
  }
}

// Groups of points chained by steps of at most kContactCluster.
std::vector<std::vector<int>> ChainedGroups(const std::vector<Vec3>& points) {
  const PointIndex index(points);
  std::vector<bool> taken(points.size(), false);
  std::vector<std::vector<int>> groups;
  std::vector<int> found;
  for (size_t seed = 0; seed < points.size(); ++seed) {
    if (taken[seed]) continue;
    taken[seed] = true;
    std::vector<int> group = {static_cast<int>(seed)};
    for (size_t next = 0; next < group.size(); ++next) {
      index.WithinRadius(points[group[next]], kContactCluster, found);
      for (const int i : found) {
        if (!taken[i]) group.push_back(i);
        taken[i] = true;
      }
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

// Where the wires of a contact meet: at the end of one that ends here, or else where the means of
// the nearest points on each converge (sampling alone misses a slanted meeting by millimetres).
Vec3 MeetingPoint(const WireObject& object, const Contact& contact) {
  constexpr int kIterations = 40;
  for (const int i : contact.curves) {
    const Polyline& points = object.curves[i].points;
    if (object.curves[i].IsClosed()) continue;
    for (const Vec3& end : {points.front(), points.back()}) {
      if ((end - contact.position).norm() < kEndReach) return end;
    }
  }
  Vec3 meeting = contact.position;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Vec3 sum = Vec3::Zero();
    for (const int i : contact.curves) {
      const Polyline& points = object.curves[i].points;
      sum += PointAt(points, CumulativeLength(points), Project(points, meeting).arc_length);
    }
    meeting = sum / static_cast<double>(contact.curves.size());
  }
  return meeting;
}

std::vector<Contact> FindContacts(const WireObject& object) {
  std::vector<Vec3> midpoints;
  std::vector<std::pair<int, int>> curves;
  FindTouches(SampleCurves(object), midpoints, curves);
  std::vector<Contact> contacts;
  for (const std::vector<int>& group : ChainedGroups(midpoints)) {
    Contact contact;
    for (const int i : group) {
      contact.position += midpoints[i] / static_cast<double>(group.size());
      contact.curves.push_back(curves[i].first);
      contact.curves.push_back(curves[i].second);
    }
    std::sort(contact.curves.begin(), contact.curves.end());
    contact.curves.erase(std::unique(contact.curves.begin(), contact.curves.end()),
                         contact.curves.end());
    contact.position = MeetingPoint(object, contact);
    contacts.push_back(std::move(contact));
  }
  return contacts;
}

// A node on a curve, by arc length.
struct Stop {
  double arc_length = 0;
  NodeId node = 0;
};

// The nodes of a curve in order: its contacts, and its free ends; a loop's first stop is repeated a
// round later.
std::vector<Stop> StopsOf(const WireCurve& curve, std::vector<Stop> stops, SkeletonGraph& graph) {
  const double length = Length(curve.points);
  if (!curve.IsClosed()) {
    for (Stop& stop : stops) {
      if (stop.arc_length < kEndReach) stop.arc_length = 0;
      if (stop.arc_length > length - kEndReach) stop.arc_length = length;
    }
  } else if (stops.empty()) {
    stops.push_back({0, graph.AddNode(curve.points.front())});
  }
  std::sort(stops.begin(), stops.end(),
            [](const Stop& a, const Stop& b) { return a.arc_length < b.arc_length; });
  if (curve.IsClosed()) {
    stops.push_back({stops.front().arc_length + length, stops.front().node});
    return stops;
  }
  if (stops.empty() || stops.front().arc_length > 0) {
    stops.insert(stops.begin(), {0, graph.AddNode(curve.points.front())});
  }
  if (stops.back().arc_length < length) {
    stops.push_back({length, graph.AddNode(curve.points.back())});
  }
  return stops;
}

// At an arc length, which may lie one round on where the wire is closed.
double RadiusAt(const WireCurve& curve, const std::vector<double>& cumulative, double arc_length) {
  if (curve.diameters.empty()) return curve.diameter / 2;
  if (arc_length > cumulative.back()) arc_length -= cumulative.back();
  const auto after = std::upper_bound(cumulative.begin(), cumulative.end() - 1, arc_length);
  const size_t i = std::max<std::ptrdiff_t>(after - cumulative.begin(), 1);
  const double share = (arc_length - cumulative[i - 1]) / (cumulative[i] - cumulative[i - 1]);
  return ((1 - share) * curve.diameters[i - 1] + share * curve.diameters[i]) / 2;
}

// The part of a curve between two stops, its ends bent to the nodes. Vertices within a tenth of a
// millimetre of a stop are left out, so that no segment degenerates.
void AddPart(const WireCurve& curve, const Stop& from, const Stop& to, SkeletonGraph& graph) {
  constexpr double kClear = 1e-4;
  const std::vector<double> cumulative = CumulativeLength(curve.points);
  SkeletonEdge edge;
  edge.nodes = {from.node, to.node};
  edge.points = {graph.position(from.node)};
  edge.radii = {RadiusAt(curve, cumulative, from.arc_length)};
  const int rounds = curve.IsClosed() ? 2 : 1;
  for (int round = 0; round < rounds; ++round) {
    for (size_t i = round; i < curve.points.size(); ++i) {
      const double at = cumulative[i] + round * cumulative.back();
      if (at > from.arc_length + kClear && at < to.arc_length - kClear &&
          curve.points[i] != edge.points.back()) {  // shapes joined end to end repeat a point
        edge.points.push_back(curve.points[i]);
        edge.radii.push_back(curve.DiameterAt(i) / 2);
      }
    }
  }
  edge.points.push_back(graph.position(to.node));
  edge.radii.push_back(RadiusAt(curve, cumulative, to.arc_length));
  graph.AddEdge(std::move(edge));
}

// Where wires come near each other, of each curve.
std::vector<std::vector<Stop>> StopsByNearness(const WireObject& object, SkeletonGraph& graph) {
  std::vector<std::vector<Stop>> stops_of_curve(object.curves.size());
  for (const Contact& contact : FindContacts(object)) {
    const NodeId node = graph.AddNode(contact.position);
    for (const int i : contact.curves) {
      const double at = Project(object.curves[i].points, contact.position).arc_length;
      stops_of_curve[i].push_back({at, node});
    }
  }
  return stops_of_curve;
}

// Where wires share a point, of each curve.
std::vector<std::vector<Stop>> StopsBySharedPoints(const WireObject& object, SkeletonGraph& graph) {
  struct Place {
    int uses = 0;
    NodeId node = -1;
  };
  const auto before = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  std::map<Vec3, Place, decltype(before)> places(before);
  const auto own_points = [](const WireCurve& curve) {
    return curve.points.size() - (curve.IsClosed() ? 1 : 0);
  };
  for (const WireCurve& curve : object.curves) {
    for (size_t k = 0; k < own_points(curve); ++k) ++places[curve.points[k]].uses;
  }
  std::vector<std::vector<Stop>> stops_of_curve(object.curves.size());
  for (size_t i = 0; i < object.curves.size(); ++i) {
    const WireCurve& curve = object.curves[i];
    const std::vector<double> cumulative = CumulativeLength(curve.points);
    for (size_t k = 0; k < own_points(curve); ++k) {
      Place& place = places[curve.points[k]];
      if (place.uses < 2) continue;
      if (place.node < 0) place.node = graph.AddNode(curve.points[k]);
      stops_of_curve[i].push_back({cumulative[k], place.node});
    }
  }
  return stops_of_curve;
}

}  // namespace

SkeletonGraph TruthSkeleton(const WireObject& object) {
  SkeletonGraph graph;
  const std::vector<std::vector<Stop>> contacts_of_curve = object.welds == WeldRule::kNearness
                                                               ? StopsByNearness(object, graph)
                                                               : StopsBySharedPoints(object, graph);
  for (size_t i = 0; i < object.curves.size(); ++i) {
    const std::vector<Stop> stops = StopsOf(object.curves[i], contacts_of_curve[i], graph);
    for (size_t k = 0; k + 1 < stops.size(); ++k) {
      AddPart(object.curves[i], stops[k], stops[k + 1], graph);
    }
  }
  graph.DissolveDegree2Nodes();
  graph.RemoveIsolatedNodes();
  return graph;
}

std::vector<WireCurve> WiresOf(const SkeletonGraph& skeleton, const std::string& source) {
  if (skeleton.empty()) {
    throw Error(ErrorKind::kBadInput, source + ": has no curve that could be simulated");
  }
  std::vector<WireCurve> wires;
  for (const EdgeId id : skeleton.Edges()) {
    const SkeletonEdge& edge = skeleton.edge(id);
    if (edge.radii.empty()) {
      throw Error(ErrorKind::kBadInput,
                  source + ": edge " + std::to_string(id) + " has no radius; a wire needs one");
    }
    const double sum = std::accumulate(edge.radii.begin(), edge.radii.end(), 0.0);
    WireCurve wire{edge.points, 2 * sum / static_cast<double>(edge.radii.size())};
    if (std::ranges::min(edge.radii) != std::ranges::max(edge.radii)) {
      for (const double radius : edge.radii) wire.diameters.push_back(2 * radius);
    }
    wires.push_back(std::move(wire));
  }
  return wires;
}

void WriteCurves(const std::filesystem::path& path, const WireObject& object) {
  nlohmann::json curves = nlohmann::json::array();
  for (const WireCurve& curve : object.curves) {
    nlohmann::json points = nlohmann::json::array();
    const size_t count = curve.points.size() - (curve.IsClosed() ? 1 : 0);
    for (size_t i = 0; i < count; ++i) {
      points.push_back({curve.points[i].x(), curve.points[i].y(), curve.points[i].z()});
    }
    curves.push_back(
        {{"diameter", curve.diameter}, {"closed", curve.IsClosed()}, {"points", points}});
    if (!curve.diameters.empty()) {
      curves.back()["diameters"] =
          std::vector<double>(curve.diameters.begin(), curve.diameters.begin() + count);
    }
  }
  WriteStreamAtomically(path, [&](std::ostream& stream) { stream << curves.dump() << "\n"; });
}

}  // namespace curvefusion
