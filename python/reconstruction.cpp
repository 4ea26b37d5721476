// The whole method, and the comparison of what it finds with the truth.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <chrono>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "capture/content/colour_findings.h"
#include "experiments/config.h"
#include "experiments/metrics/evaluation_files.h"
#include "experiments/metrics/truth.h"
#include "experiments/run_report.h"
#include "fusion/pipeline.h"
#include "fusion/tracking/tracked_poses.h"
#include "graph/graph_figures.h"
#include "kernel/peak_memory.h"
#include "meshing/io/mesh_io.h"
#include "python/bindings.h"
#include "python/interruptible.h"

namespace curvefusion {

namespace py = pybind11;

namespace {

using Clock = std::chrono::steady_clock;

struct Result {
  std::shared_ptr<SkeletonGraph> skeleton;
  std::shared_ptr<SkeletonGraph> uncertain;
  std::shared_ptr<Sequence> sequence;
  std::vector<Vec3> points;
  double global_radius = 0;
  std::vector<std::string> warnings;
  std::string report;  // JSON
  std::string config;  // TOML
};

class ProgressObserver : public PipelineObserver {
 public:
  explicit ProgressObserver(const Progress& progress) : progress_(progress) {}
  void OnProgress(const std::string& stage, int64_t done, int64_t total) override {
    progress_(stage, done, total);
  }

 private:
  const Progress& progress_;
};

Result ResultOf(const RunRecord& record, Reconstruction& reconstruction) {
  Result result;
  result.report = ReportJson(record);
  result.warnings = AllWarnings(record);
  result.config = ConfigToml(record.config);
  result.skeleton = Shared(reconstruction.skeleton);
  result.uncertain = Shared(reconstruction.uncertain.graph);
  result.global_radius = reconstruction.radii.global_radius;
  result.points = std::move(reconstruction.points.positions);
  result.sequence = std::make_shared<Sequence>(std::move(reconstruction.sequence));
  return result;
}

Result Run(Sequence sequence, const Config& config, const Progress& progress) {
  const auto start = Clock::now();
  const bool fitted = UseFittedColourCamera(sequence);
  const std::optional<TrackingResult> tracking = FindPoses(sequence, progress);
  ProgressObserver observer(progress);
  Reconstruction reconstruction = Reconstruct(sequence, config.pipeline, observer);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  const RunRecord record{sequence, config,       reconstruction, {},
                         seconds,  PeakMemory(), fitted,         tracking};
  return ResultOf(record, reconstruction);
}

// A value as TOML writes it; texts as they are, as after --set.
std::string SettingText(const py::handle& value) {
  if (PyBool_Check(value.ptr())) return value.cast<bool>() ? "true" : "false";
  if (PyIndex_Check(value.ptr())) return py::str(py::int_(value.cast<py::object>()));
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  return py::repr(py::float_(value.cast<py::object>()));
}

Config ConfigOf(const std::string& profile, const py::dict& settings) {
  ConfigSources sources;
  sources.profile = ProfileNamed(profile);
  for (const auto& [name, value] : settings) {
    sources.assignments.push_back(name.cast<std::string>() + "=" + SettingText(value));
  }
  return ReadConfig(sources);
}

Result ReconstructIn(const py::object& source, const std::string& profile, const py::dict& settings,
                     const py::object& progress) {
  const Config config = ConfigOf(profile, settings);
  Sequence sequence;
  const bool is_open = py::isinstance<Sequence>(source);
  std::filesystem::path folder;
  if (is_open) {
    sequence = source.cast<const Sequence&>();
  } else {
    folder = source.cast<std::filesystem::path>();
  }
  Result result;
  RunInterruptibly(progress, [&](const Progress& inner) {
    const DepthUse depth = DepthUseOf(config.pipeline);
    if (!is_open) sequence = OpenSequence(folder, PoseUse::kIfGiven, depth);
    if (depth == DepthUse::kIgnored) sequence = WithoutDepth(std::move(sequence));
    result = Run(std::move(sequence), config, inner);
  });
  return result;
}

py::array EdgeRadii(const Result& result) {
  const std::vector<double> radii = MeasureGraph(*result.skeleton).edge_radius;
  py::array_t<double> array(static_cast<py::ssize_t>(radii.size()));
  for (size_t i = 0; i < radii.size(); ++i) {
    const bool known = radii[i] > 0;
    array.mutable_at(i) = known ? radii[i] : std::numeric_limits<double>::quiet_NaN();
  }
  return array;
}

py::object EvaluateIn(const SkeletonGraph& skeleton, const py::object& truth,
                      const std::optional<std::filesystem::path>& mesh) {
  std::shared_ptr<const SkeletonGraph> given;
  std::filesystem::path path;
  if (py::isinstance<SkeletonGraph>(truth)) {
    given = truth.cast<std::shared_ptr<SkeletonGraph>>();
    RequireRadii(*given, "truth");
  } else {
    path = truth.cast<std::filesystem::path>();
  }
  return FromJson(Interruptible([&] {
    const SkeletonGraph expected = given ? *given : ReadTruth(path);
    std::optional<TriangleMesh> surface;
    if (mesh) surface = ReadMesh(*mesh);
    return EvaluationText({"", path.string()},
                          Evaluate(skeleton, surface ? &*surface : nullptr, expected));
  }));
}

constexpr const char* kReconstructDocs = R"(Turn an RGB-D sequence into a curve skeleton.

What `curvefusion reconstruct` does, without its files: where colour lies beside depth
the colour camera is fitted, where there are no poses the camera is tracked. What
depth images are used for is the setting "depth.use": with "none", colour images and
poses alone.

Parameters
----------
sequence : Sequence or path
    From `read_sequence`, or a folder.
profile : {'best', 'paper'}
    'paper': exactly the published method.
settings : dict of str, optional
    {"section.key": value}; `curvefusion config` prints them with unit, range and
    meaning.
progress : callable(stage, done, total), optional
    Called now and then on the calling thread: the name of the stage and how many of
    its steps are done. An exception that it raises ends the run and passes on.

Returns
-------
Result
    Its skeleton has no edges where nothing thin was found.

Raises
------
UsageError
    An unknown profile or setting, or a value out of range.
BadInputError
    A scan that cannot be used; the message names file, frame, value and remedy.
KeyboardInterrupt
    Ctrl-C; it ends all work of the process.
)";

constexpr const char* kEvaluateDocs = R"(Compare a skeleton with a known truth.

Parameters
----------
skeleton : SkeletonGraph
truth : SkeletonGraph or path
    With radii; or the truth/ folder of a simulated scan, a skeleton.json or a
    curves.json.
mesh : path, optional
    A mesh file in metres to compare with the true tubes.

Returns
-------
dict
    What `curvefusion evaluate --json` writes: lengths in mm where the key ends in
    `_mm`, otherwise in metres; None where there is nothing to take a share of.

Raises
------
BadInputError
    A truth without radii, a file that cannot be read.
)";

void BindResult(py::module_& module) {
  py::class_<Result>(module, "Result", "What `reconstruct` found.")
      .def_readonly("skeleton", &Result::skeleton,
                    "SkeletonGraph in the world frame; without edges where nothing was found.")
      .def_readonly("uncertain", &Result::uncertain,
                    "SkeletonGraph of curves that may be thin but are no proven wires.")
      .def_property_readonly("radii", &EdgeRadii,
                             "(E,) float64, metres: the median of every edge of the skeleton, NaN "
                             "where it is unknown.")
      .def_property_readonly(
          "global_radius",
          [](const Result& r) {
            return r.global_radius > 0 ? std::optional<double>(r.global_radius) : std::nullopt;
          },
          "The most prominent radius in metres; None where it is unknown.")
      .def_readonly("sequence", &Result::sequence, "The sequence with its poses as corrected.")
      .def_property_readonly(
          "poses",
          [](const py::object& self) -> py::object { return self.attr("sequence").attr("poses"); },
          "(N, 4, 4) float64: depth camera to world as corrected, metres.")
      .def_property_readonly(
          "points",
          [](const py::object& self) { return PointView(self.cast<const Result&>().points, self); },
          "(N, 3) float64, metres: the points that the skeleton was made from; refers to memory "
          "of the result, not writable.")
      .def_property_readonly(
          "warnings", [](const Result& r) { return Texts(r.warnings); }, "List of str.")
      .def_property_readonly(
          "report", [](const Result& r) { return FromJson(r.report); },
          "Dict as report.json holds it: `stages`, `funnel`, `trust`, `skeleton` and more.")
      .def_readonly("config", &Result::config,
                    "Every setting that was in force, as the text of a config.toml.");
}

}  // namespace

void BindReconstruction(py::module_& module) {
  BindResult(module);
  module.def("reconstruct", &ReconstructIn, py::arg("sequence"), py::arg("profile") = "best",
             py::arg("settings") = py::dict(), py::arg("progress") = py::none(), kReconstructDocs);
  module.def("evaluate", &EvaluateIn, py::arg("skeleton"), py::arg("truth"),
             py::arg("mesh") = py::none(), kEvaluateDocs);
}

}  // namespace curvefusion
