// The skeleton graph: files, arrays, exact splitting, smoothing, and the curves of a cloud.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

#include "graph/contraction/cloud_curves.h"
#include "graph/intersections.h"
#include "graph/io/graph_io.h"
#include "graph/smoothing.h"
#include "graph/validate.h"
#include "kernel/error.h"
#include "python/bindings.h"
#include "python/interruptible.h"

namespace curvefusion {

namespace py = pybind11;

namespace {

using Graph = std::shared_ptr<SkeletonGraph>;
using Edge = std::shared_ptr<SkeletonEdge>;

// Metres: beyond it no two curves of an object are apart.
constexpr double kLargestDistance = 10;

// One value a point: None = none, a number = the same for all.
std::vector<double> ValuesOfPoints(const py::object& values, size_t points,
                                   const std::string& name) {
  if (values.is_none()) return {};
  const auto array = Numbers::ensure(values);
  if (!array) throw py::error_already_set();
  if (array.ndim() == 0) return std::vector<double>(points, *array.data());
  if (array.ndim() != 1 || static_cast<size_t>(array.size()) != points) {
    throw Error(ErrorKind::kUsage,
                fmt::format("{}: needs one value for each of {} points, or one for all; it has {}",
                            name, points, array.size()));
  }
  return {array.data(), array.data() + array.size()};
}

Edge MakeEdge(const std::array<int, 2>& nodes, const Numbers& points, const py::object& radii,
              const py::object& observations) {
  auto edge = std::make_shared<SkeletonEdge>();
  edge->nodes = nodes;
  edge->points = Points(points, "points");
  edge->radii = ValuesOfPoints(radii, edge->points.size(), "radii");
  edge->observations = ValuesOfPoints(observations, edge->points.size(), "observations");
  return edge;
}

void RequireSound(const SkeletonEdge& edge, size_t index, const SkeletonGraph& graph) {
  for (const NodeId node : edge.nodes) {
    if (graph.HasNode(node)) continue;
    throw Error(ErrorKind::kBadInput,
                fmt::format("edges[{}]: there is no node {}; nodes count from 0 to {}", index, node,
                            graph.node_count() - 1));
  }
  const std::vector<std::string> faults = EdgeFaults(edge, graph);
  if (faults.empty()) return;
  throw Error(ErrorKind::kBadInput, fmt::format("edges[{}]: {}", index, fmt::join(faults, "; ")));
}

Graph MakeGraph(const Numbers& nodes, const std::vector<Edge>& edges) {
  auto graph = std::make_shared<SkeletonGraph>();
  if (nodes.size() > 0) {
    for (const Vec3& position : Points(nodes, "nodes")) graph->AddNode(position);
  }
  for (size_t i = 0; i < edges.size(); ++i) {
    if (!edges[i]) throw py::type_error(fmt::format("edges[{}]: is None and no Edge", i));
    RequireSound(*edges[i], i, *graph);
    graph->AddEdge(*edges[i]);
  }
  const std::vector<std::string> faults = Faults(*graph);
  if (!faults.empty()) throw Error(ErrorKind::kBadInput, faults.front());
  return graph;
}

py::array NodePositions(const SkeletonGraph& graph) {
  py::array_t<double> positions({static_cast<py::ssize_t>(graph.node_count()), py::ssize_t{3}});
  for (int node = 0; node < graph.node_count(); ++node) {
    Eigen::Map<Vec3>(positions.mutable_data(node, 0)) = graph.position(node);
  }
  return positions;
}

// Each keeps the graph alive.
std::vector<Edge> EdgesOf(const Graph& graph) {
  std::vector<Edge> edges;
  for (const EdgeId id : graph->Edges()) {
    edges.emplace_back(graph, const_cast<SkeletonEdge*>(&graph->edge(id)));
  }
  return edges;
}

Graph Load(const std::filesystem::path& path) {
  return Interruptible([&] { return Shared(ReadSkeleton(path)); });
}

py::list Save(const SkeletonGraph& graph, const std::filesystem::path& path) {
  return Texts(Interruptible([&] { return ExportSkeleton(path, graph); }));
}

py::list ViolationsOf(const SkeletonGraph& graph, double proximity) {
  RequireWithin("proximity", proximity, 0, kLargestDistance);
  return Texts(Interruptible([&] { return Violations(graph, proximity); }));
}

Graph Resolved(const SkeletonGraph& graph, double distance) {
  RequireWithin("distance", distance, 0, kLargestDistance);
  return Interruptible([&] {
    SkeletonGraph resolved = graph;
    ResolveIntersections(resolved, distance);
    return Shared(resolved);
  });
}

Graph Smoothed(const SkeletonGraph& graph, double weight) {
  RequireWithin("weight", weight, 0, 1e9);
  SmoothingOptions options;
  options.lambda = weight;
  return Interruptible([&] { return Shared(SmoothGraph(graph, options)); });
}

ObservedPoints Cloud(const Numbers& points, const py::object& rays) {
  ObservedPoints cloud;
  cloud.positions = Points(points, "points");
  cloud.viewing_rays.assign(cloud.size(), Vec3::Zero());
  cloud.counts.assign(cloud.size(), 1);
  if (rays.is_none()) return cloud;
  cloud.viewing_rays = Points(rays.cast<Numbers>(), "rays");
  if (cloud.viewing_rays.size() != cloud.size()) {
    throw Error(ErrorKind::kUsage, fmt::format("rays: {} for {} points; needed is one for each",
                                               cloud.viewing_rays.size(), cloud.size()));
  }
  for (Vec3& ray : cloud.viewing_rays) {
    if (!ray.allFinite()) throw Error(ErrorKind::kBadInput, "rays: all must be finite");
    if (!ray.isZero(0)) ray.normalize();
  }
  return cloud;
}

Graph Contract(const Numbers& points, double radius, double neighbourhood,
               const std::string& method, const py::object& rays) {
  RequireWithin("radius", radius, 0, kLargestDistance);
  RequireWithin("neighbourhood", neighbourhood, 0, kLargestDistance);
  const CloudCurveOptions options{CloudMethodNamed(method), neighbourhood, radius};
  const ObservedPoints cloud = Cloud(points, rays);
  return Interruptible([&] { return Shared(CurvesOfCloud(cloud, options)); });
}

constexpr const char* kEdgeDocs =
    R"(A curve between two nodes of a SkeletonGraph. It does not change.

Parameters
----------
nodes : pair of int
    Indices of the nodes that it runs between; twice the same for a closed curve.
points : (M, 3) array
    Metres, from the first node to the second, both included; the ends must equal
    the nodes bit for bit.
radii : float or (M,) array, optional
    Radius of the wire in metres, > 0.
observations : float or (M,) array, optional
    In how many images each point was seen.

Raises
------
UsageError
    Arrays of other shapes. Values are looked at when a graph is made of the edge.
)";

constexpr const char* kGraphDocs =
    R"(Curves in space that meet in nodes: an undirected multigraph. It does not change.

Parameters
----------
nodes : (N, 3) array
    Metres.
edges : sequence of Edge

Raises
------
UsageError
    Arrays of other shapes.
BadInputError
    Edges of nodes that do not exist, or that do not end there; fewer than two
    points, repeated points, values that are not finite, radii that are not positive.
)";

constexpr const char* kLoadDocs = R"(Read a graph.

Parameters
----------
path : path
    .json, .graphml, .ply, .obj (metres) or .swc (micrometres).

Returns
-------
SkeletonGraph

Raises
------
UsageError
    Another extension.
BadInputError
    A file that cannot be read or is not a graph.
)";

constexpr const char* kSaveDocs = R"(Write the graph; the file appears when it is complete.

Parameters
----------
path : path
    .json or .graphml (metres, bit for bit), .ply or .obj (metres), .swc
    (micrometres, a forest), .dxf (millimetres, 3D polylines), .svg
    (millimetres, three views), .usda (metres).

Returns
-------
list of str
    What the format does not keep of this graph, a sentence each.

Raises
------
UsageError
    Another extension.
ResourceError
    The file cannot be written.
)";

constexpr const char* kValidateDocs = R"(Tell what is wrong with the graph, a sentence each.

Parameters
----------
proximity : float
    Metres: how near curves may come without meeting.

Returns
-------
list of str
    Empty for a valid graph. Decided exactly on the coordinates as they are.
)";

constexpr const char* kResolveDocs =
    R"(Make junctions where curves cross or come near, and merge what runs side by side.

Which curves meet is decided exactly on the coordinates as they are; the result is
valid for the distance, and resolving it again changes nothing.

Parameters
----------
distance : float
    Metres, 0 to 10.

Returns
-------
SkeletonGraph
    A new one.
)";

constexpr const char* kSmoothDocs = R"(Resample to 1 mm and smooth (CurveFusion 4.3, Eq. 1).

Parameters
----------
weight : float
    Of smoothness against the data, > 0, without unit; 60 in the paper.

Returns
-------
SkeletonGraph
    A new one. Free ends and corners stay.

Raises
------
BadInputError
    More than a million steps (1000 m of curve).
)";

constexpr const char* kContractDocs = R"(Contract a point cloud of thin structures to its curves.

Parameters
----------
points : (N, 3) array
    Metres.
radius : float
    Radius of the wires in metres, stored with the curves; 0 = unknown.
neighbourhood : float
    First radius of the method 'l1' in metres, about three times the wires'
    thickness; 0 = from the cloud.
method : {'auto', 'ridge', 'l1'}
    Density ridges, for wires of 2 to 12 mm, also close ones; or the paper's L1 axis,
    for any size; 'auto' decides by the thickness of the cloud.
rays : (N, 3) array, optional
    Directions from the camera to the points. With a radius, points are moved along
    them from the wires' surface to the axis.

Returns
-------
SkeletonGraph
    Without edges where there is nothing curve-like.

Raises
------
UsageError
    Arrays of other shapes, another method.
BadInputError
    A point that is not finite.
)";

void BindEdge(py::module_& module) {
  py::class_<SkeletonEdge, Edge>(module, "Edge", kEdgeDocs)
      .def(py::init(&MakeEdge), py::arg("nodes"), py::arg("points"), py::arg("radii") = py::none(),
           py::arg("observations") = py::none())
      .def_property_readonly(
          "nodes", [](const SkeletonEdge& e) { return py::make_tuple(e.nodes[0], e.nodes[1]); },
          "Indices of the two nodes.")
      .def_property_readonly(
          "points",
          [](const py::object& self) {
            return PointView(self.cast<const SkeletonEdge&>().points, self);
          },
          "(M, 3) float64, metres; refers to memory of the graph, not writable.")
      .def_property_readonly(
          "radii",
          [](const py::object& self) {
            return ValueView(self.cast<const SkeletonEdge&>().radii, self);
          },
          "(M,) float64, metres; None where they are unknown. Not writable.")
      .def_property_readonly(
          "observations",
          [](const py::object& self) {
            return ValueView(self.cast<const SkeletonEdge&>().observations, self);
          },
          "(M,) float64; None where they are unknown. Not writable.")
      .def_property_readonly(
          "length", [](const SkeletonEdge& e) { return Length(e.points); }, "Metres.");
}

}  // namespace

void BindSkeleton(py::module_& module) {
  BindEdge(module);
  py::class_<SkeletonGraph, Graph>(module, "SkeletonGraph", kGraphDocs)
      .def(py::init(&MakeGraph), py::arg("nodes"), py::arg("edges"))
      .def_static("load", &Load, py::arg("path"), kLoadDocs)
      .def("save", &Save, py::arg("path"), kSaveDocs)
      .def_property_readonly("nodes", &NodePositions, "(N, 3) float64, metres; a copy.")
      .def_property_readonly("edges", &EdgesOf, "List of Edge.")
      .def_property_readonly("length", &SkeletonGraph::TotalLength, "Metres, of all curves.")
      .def("validate", &ViolationsOf, py::arg("proximity") = 0.001, kValidateDocs)
      .def("resolve", &Resolved, py::arg("distance"), kResolveDocs)
      .def("smooth", &Smoothed, py::arg("weight") = 60.0, kSmoothDocs)
      .def("__repr__", [](const SkeletonGraph& graph) {
        return fmt::format("<SkeletonGraph of {} nodes, {} edges, {:.3f} m>", graph.node_count(),
                           graph.edge_count(), graph.TotalLength());
      });
  module.def("contract", &Contract, py::arg("points"), py::arg("radius") = 0.0,
             py::arg("neighbourhood") = 0.0, py::arg("method") = "auto",
             py::arg("rays") = py::none(), kContractDocs);
}

}  // namespace curvefusion
