// Tube meshes: making, examining and writing them.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>

#include "graph/set_radius.h"
#include "kernel/error.h"
#include "meshing/io/mesh_io.h"
#include "meshing/tube_normals.h"
#include "meshing/tube_warnings.h"
#include "meshing/tubes.h"
#include "meshing/watertight.h"
#include "python/bindings.h"
#include "python/interruptible.h"

namespace curvefusion {

namespace py = pybind11;

namespace {

struct PythonMesh {
  TriangleMesh mesh;
  std::optional<CornerNormals> normals;    // of tubes
  std::optional<WatertightReport> report;  // once it is known
  std::vector<std::string> warnings;
};

PythonMesh MakeTubes(const SkeletonGraph& skeleton, std::optional<double> radius,
                     const std::string& radius_from, int sides) {
  TubeOptions options;
  RequireWithin("sides", sides, 8, 64);
  options.sides = sides;
  if (radius) RequireWithin("radius", *radius, 1e-9, 1e3);
  return Interruptible([&]() -> PythonMesh {
    SkeletonGraph graph = skeleton;
    if (radius) {
      SetRadius(*radius, graph);
    } else {
      ReduceRadii(radius_from, graph);
    }
    const TubeMesh tubes = BuildTubes(graph, options);
    TriangleMesh mesh = ToTriangleMesh(tubes.surface);
    CornerNormals normals = ComputeTubeNormals(mesh, tubes.paths);
    return {std::move(mesh), std::move(normals), tubes.report, TubeWarnings(graph, tubes, options)};
  });
}

PythonMesh Load(const std::filesystem::path& path) {
  return Interruptible([&] { return PythonMesh{ReadMesh(path), {}, {}, {}}; });
}

void Save(const PythonMesh& mesh, const std::filesystem::path& path,
          const std::optional<std::string>& unit) {
  MeshFileOptions options;
  if (unit && *unit != "m" && *unit != "mm") {
    throw Error(ErrorKind::kUsage, "there is no unit " + *unit + "; name m or mm");
  }
  if (unit) options.unit = *unit == "m" ? MeshUnit::kMetres : MeshUnit::kMillimetres;
  if (mesh.normals) options.normals = &*mesh.normals;
  RunInterruptibly(py::none(), [&](const Progress&) { WriteMesh(path, mesh.mesh, options); });
}

const WatertightReport& Report(PythonMesh& mesh) {
  if (!mesh.report) mesh.report = Interruptible([&] { return ExamineMesh(mesh.mesh); });
  return *mesh.report;
}

py::dict Check(PythonMesh& mesh) {
  const WatertightReport& report = Report(mesh);
  py::dict figures;
  figures["watertight"] = report.IsWatertight();
  figures["defects"] = report.Defects();
  figures["vertices"] = report.vertices;
  figures["faces"] = report.faces;
  figures["components"] = report.components;
  figures["genus"] = report.genus;
  figures["volume"] = report.volume;
  figures["area"] = report.area;
  figures["boundary_edges"] = report.boundary_edges;
  figures["non_manifold_edges"] = report.non_manifold_edges;
  figures["non_manifold_vertices"] = report.non_manifold_vertices;
  figures["misoriented_edges"] = report.misoriented_edges;
  figures["degenerate_faces"] = report.degenerate_faces;
  figures["self_intersections"] = report.self_intersections;
  return figures;
}

py::array Vertices(const py::object& self) {
  const auto& vertices = self.cast<const PythonMesh&>().mesh.vertices;
  return View(vertices.empty() ? nullptr : vertices.front().data(),
              {static_cast<py::ssize_t>(vertices.size()), 3}, self);
}

py::array Faces(const py::object& self) {
  const auto& triangles = self.cast<const PythonMesh&>().mesh.triangles;
  return View(triangles.empty() ? nullptr : triangles.front().data(),
              {static_cast<py::ssize_t>(triangles.size()), 3}, self);
}

constexpr const char* kMeshDocs =
    R"(Make a watertight mesh of tubes around the curves of a skeleton.

Parameters
----------
skeleton : SkeletonGraph
radius : float, optional
    Radius of all tubes in metres, in place of those of the skeleton.
radius_from : {'vertex', 'edge', 'global'}
    Which radii of the skeleton: of every point, the mean of every edge, or one median.
sides : int
    Corners of a tube's cross-section, 8 to 64.

Returns
-------
Mesh
    Closed, oriented, 2-manifold and free of self-intersections; empty for a skeleton
    without edges. Radii that are unknown are taken as 2.5 mm, which `warnings` says.

Raises
------
UsageError
    An argument that cannot be.
BadInputError
    Radii or coordinates that have no sound surface; the message names the place.
)";

constexpr const char* kSaveDocs =
    R"(Write the mesh; it is read back and compared before it gets its name.

Parameters
----------
path : path
    .ply, .obj, .stl, .glb or .3mf.
unit : {'m', 'mm'}, optional
    By default metres, of .3mf millimetres; .glb is always in metres.

Raises
------
UsageError
    Another extension, or a unit that the format does not have.
BadInputError
    A mesh that is not watertight.
ResourceError
    The file cannot be written.
)";

constexpr const char* kCheckDocs =
    R"(Examine the mesh as a program that reads its file sees it, exactly.

Returns
-------
dict
    `watertight` (bool), `defects` (one sentence, empty where nothing is wrong),
    `volume` (m^3), `area` (m^2), `genus` and counts: `vertices`, `faces`,
    `components`, `boundary_edges`, `non_manifold_edges`, `non_manifold_vertices`,
    `misoriented_edges`, `degenerate_faces`, `self_intersections`.
)";

constexpr const char* kLoadDocs = R"(Read a triangle mesh, in the unit of the file.

Parameters
----------
path : path
    .ply, .obj, binary .stl, .glb or .3mf.

Returns
-------
Mesh

Raises
------
UsageError
    Another extension.
BadInputError
    A file that is missing or damaged, or is not of triangles.
)";

}  // namespace

void BindMesh(py::module_& module) {
  py::class_<PythonMesh>(module, "Mesh", "A triangle mesh, from `mesh` or `Mesh.load`.")
      .def_static("load", &Load, py::arg("path"), kLoadDocs)
      .def("save", &Save, py::arg("path"), py::arg("unit") = py::none(), kSaveDocs)
      .def("check", &Check, kCheckDocs)
      .def_property_readonly("vertices", &Vertices,
                             "(V, 3) float32, metres; refers to memory of the mesh, not writable.")
      .def_property_readonly("faces", &Faces,
                             "(F, 3) int32, counter-clockwise seen from outside; refers to memory "
                             "of the mesh, not writable.")
      .def_property_readonly(
          "watertight", [](PythonMesh& mesh) { return Report(mesh).IsWatertight(); },
          "Whether it is closed, oriented, 2-manifold and free of self-intersections.")
      .def_property_readonly(
          "warnings", [](const PythonMesh& mesh) { return Texts(mesh.warnings); },
          "List of str: radii that were assumed, junctions that did not come out at once.");
  module.def("mesh", &MakeTubes, py::arg("skeleton"), py::arg("radius") = py::none(),
             py::arg("radius_from") = "vertex", py::arg("sides") = 16, kMeshDocs);
}

}  // namespace curvefusion
