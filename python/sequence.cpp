// Sequences: opening, looking into and checking them.
#include "capture/sequence.h"

#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iterator>

#include "capture/check.h"
#include "capture/check_json.h"
#include "python/bindings.h"
#include "python/interruptible.h"

namespace curvefusion {

namespace py = pybind11;

namespace {

py::array CameraMatrix(const PinholeCamera& camera) {
  py::array_t<double> matrix({3, 3});
  const double values[] = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  std::copy(std::begin(values), std::end(values), matrix.mutable_data());
  return matrix;
}

py::object Poses(const Sequence& sequence) {
  if (!sequence.has_poses) return py::none();
  return Matrices(CameraPoses(sequence));
}

py::array Timestamps(const Sequence& sequence) {
  py::array_t<double> stamps(sequence.frame_count());
  for (int i = 0; i < sequence.frame_count(); ++i) {
    stamps.mutable_at(i) = sequence.frames[static_cast<size_t>(i)].timestamp;
  }
  return stamps;
}

// Counts from the end where negative, as lists do.
int FrameIndex(const Sequence& sequence, int frame) {
  const int count = sequence.frame_count();
  const int index = frame < 0 ? frame + count : frame;
  if (index >= 0 && index < count) return index;
  throw py::index_error("frame " + std::to_string(frame) + " of a sequence of " +
                        std::to_string(count));
}

// An array that owns the pixels of an image.
template <class Pixel, class Channel, int kChannels>
py::array TakeImage(Image<Pixel> image) {
  auto* pixels = new Image<Pixel>(std::move(image));
  const py::capsule owner(pixels, [](void* p) { delete static_cast<Image<Pixel>*>(p); });
  static_assert(sizeof(Pixel) == kChannels * sizeof(Channel));
  std::vector<py::ssize_t> shape = {pixels->height(), pixels->width()};
  if (kChannels > 1) shape.push_back(kChannels);
  return py::array_t<Channel>(shape, reinterpret_cast<const Channel*>(pixels->data()), owner);
}

py::array Depth(const Sequence& sequence, int frame) {
  const int index = FrameIndex(sequence, frame);
  DepthImage image;
  {
    const py::gil_scoped_release released;
    image = LoadDepth(sequence, index);
  }
  return TakeImage<float, float, 1>(std::move(image));
}

py::array Color(const Sequence& sequence, int frame) {
  const int index = FrameIndex(sequence, frame);
  ColorImage image;
  {
    const py::gil_scoped_release released;
    image = LoadColorAsStored(sequence, index);
  }
  return TakeImage<Rgb, uint8_t, 3>(std::move(image));
}

Sequence Open(const std::filesystem::path& folder) {
  return Interruptible([&] { return OpenSequence(folder, PoseUse::kIfGiven, DepthUse::kIfGiven); });
}

py::object Check(const std::filesystem::path& folder, const py::object& progress) {
  CheckReport report;
  RunInterruptibly(progress, [&](const Progress& inner) { report = CheckSequence(folder, inner); });
  return FromJson(CheckJson(report));
}

void BindCamera(py::module_& module) {
  py::class_<PinholeCamera>(module, "Camera",
                            "A pinhole camera that looks along +z, x right, y down.\n\n"
                            "Pixel (0, 0) is the centre of the top-left pixel.")
      .def_readonly("width", &PinholeCamera::width, "Pixels.")
      .def_readonly("height", &PinholeCamera::height, "Pixels.")
      .def_readonly("fx", &PinholeCamera::fx, "Focal length in pixels.")
      .def_readonly("fy", &PinholeCamera::fy, "Focal length in pixels.")
      .def_readonly("cx", &PinholeCamera::cx, "Principal point in pixels.")
      .def_readonly("cy", &PinholeCamera::cy, "Principal point in pixels.")
      .def_property_readonly("matrix", &CameraMatrix, "(3, 3) float64: camera to pixels.");
}

constexpr const char* kDepthDocs = R"(Decode a depth image and undo its lens distortion.

Parameters
----------
frame : int
    0 to len(sequence) - 1; negative numbers count from the end.

Returns
-------
(H, W) float32 array
    Depth along the optical axis in metres; 0 = no measurement, as everywhere where
    the sequence has no depth.

Raises
------
BadInputError
    A missing, truncated, 8-bit or wrongly sized image.
IndexError
    No such frame.
)";

constexpr const char* kColorDocs = R"(Decode a colour image and undo its lens distortion.

Parameters
----------
frame : int
    0 to len(sequence) - 1; negative numbers count from the end.

Returns
-------
(H, W, 3) uint8 array
    Red, green, blue.

Raises
------
BadInputError
    A missing, truncated or wrongly sized image.
IndexError
    No such frame.
)";

void BindSequenceClass(py::module_& module) {
  py::class_<Sequence, std::shared_ptr<Sequence>>(
      module, "Sequence",
      "An RGB-D sequence whose images are decoded when asked for; see read_sequence.")
      .def("__len__", &Sequence::frame_count)
      .def_property_readonly("frame_count", &Sequence::frame_count)
      .def_property_readonly("folder", [](const Sequence& s) { return s.folder; })
      .def_readonly("format", &Sequence::format,
                    "'tum', 'per-frame poses', 'sens' and so on: docs/formats_input.md.")
      .def_readonly("depth_camera", &Sequence::depth_camera)
      .def_readonly("color_camera", &Sequence::color_camera)
      .def_property_readonly(
          "T_color_depth", [](const Sequence& s) { return Matrix(s.T_color_depth); },
          "(4, 4) float64: depth camera to colour camera, metres.")
      .def_readonly("has_depth", &Sequence::has_depth,
                    "Whether there are depth images; otherwise colour images and poses only.")
      .def_property_readonly("poses", &Poses,
                             "(N, 4, 4) float64: depth camera to world, metres; None where the "
                             "sequence has none.")
      .def_property_readonly("timestamps", &Timestamps,
                             "(N,) float64: seconds, or frame numbers where the format has no "
                             "times.")
      .def_property_readonly("warnings", [](const Sequence& s) { return Texts(s.warnings); })
      .def("depth", &Depth, py::arg("frame"), kDepthDocs)
      .def("color", &Color, py::arg("frame"), kColorDocs);
}

constexpr const char* kReadDocs = R"(Open an RGB-D sequence; its layout is recognised.

Frames without a pose are left out; where there are no poses at all, the sequence
is opened without. So it is where there are no depth images at all, but poses.

Parameters
----------
folder : path
    One of the layouts of docs/formats_input.md, or a recording in one file.

Returns
-------
Sequence

Raises
------
BadInputError
    The first defect that would spoil a reconstruction; `check` finds all.
)";

constexpr const char* kCheckDocs = R"(Tell what is wrong with a sequence before it is reconstructed.

Decodes every image once: about 3 ms a frame of 640 x 480. What is wrong with the
data is in the result and does not raise.

Parameters
----------
folder : path
progress : callable(stage, done, total), optional
    As in `reconstruct`.

Returns
-------
dict
    What `curvefusion check --json` prints: `usable`, `sequence_format`, `figures`
    and `findings`, a list of dicts with `severity` ('error' or 'warning'), `cause`
    (a name for programs, or None) and `message`; errors first.
)";

}  // namespace

void BindSequence(py::module_& module) {
  BindCamera(module);
  BindSequenceClass(module);
  module.def("read_sequence", &Open, py::arg("folder"), kReadDocs);
  module.def("check", &Check, py::arg("folder"), py::arg("progress") = py::none(), kCheckDocs);
}

}  // namespace curvefusion
