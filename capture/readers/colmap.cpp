#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "capture/distortion_keys.h"
#include "capture/json_fields.h"
#include "capture/readers/frame_assembly.h"
#include "capture/readers/readers.h"
#include "capture/trajectory.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

constexpr double kMillimetreUnits = 1000;
constexpr size_t kMaxLine = 65536;    // of cameras and images; names are far shorter
constexpr uint64_t kPointBytes = 24;  // x, y and the id of its 3D point
constexpr uint64_t kMaxSide = 65536;  // pixels, as in intrinsics.json

// The models by their numbers in binary files, with their parameters: f is fx and fy; k1 k2 p1 p2
// as of OpenCV; a model without parameters here is not undone.
struct Model {
  std::string_view name;
  int parameters;
  std::string_view order;
};
constexpr std::array<Model, 11> kModels = {{{"SIMPLE_PINHOLE", 3, "fxy"},
                                            {"PINHOLE", 4, "FGxy"},
                                            {"SIMPLE_RADIAL", 4, "fxy1"},
                                            {"RADIAL", 5, "fxy12"},
                                            {"OPENCV", 8, "FGxy12pq"},
                                            {"OPENCV_FISHEYE", 8, ""},
                                            {"FULL_OPENCV", 12, ""},
                                            {"FOV", 5, ""},
                                            {"SIMPLE_RADIAL_FISHEYE", 4, ""},
                                            {"RADIAL_FISHEYE", 5, ""},
                                            {"THIN_PRISM_FISHEYE", 12, ""}}};

struct ColmapCamera {
  const Model* model = nullptr;
  int width = 0;
  int height = 0;
  std::vector<double> parameters;

  bool operator==(const ColmapCamera& other) const {
    return model == other.model && width == other.width && height == other.height &&
           parameters == other.parameters;
  }
};

struct ColmapImage {
  std::string name;  // a path below the folder of images
  int64_t camera = 0;
  std::array<double, 4> quaternion{};   // w, x, y, z of the rotation from world to camera
  std::array<double, 3> translation{};  // from world to camera
};

struct ColmapModel {
  std::map<int64_t, ColmapCamera> cameras;
  std::vector<ColmapImage> images;
};

[[noreturn]] void Fail(const std::string& message) { throw Error(ErrorKind::kBadInput, message); }

int Side(uint64_t pixels, const std::string& where) {
  if (pixels >= 1 && pixels <= kMaxSide) return static_cast<int>(pixels);
  Fail(fmt::format("{}: an image side of {} pixels; 1 to {} can be", where, pixels, kMaxSide));
}

// One value after the other from the words of a line, or from bytes.
class TextFields {
 public:
  TextFields(std::string_view line, std::string where) : rest_(line), where_(std::move(where)) {}

  double Number(const char* what) {
    const std::string_view word = NextWord(rest_);
    const auto value = ParseNumber(word);
    if (!value) Fail(fmt::format("{}: {} is '{}', a number is needed", where_, what, word));
    return *value;
  }
  int64_t Integer(const char* what) {
    const std::string_view word = NextWord(rest_);
    const auto value = ParseInteger(word);
    if (!value) Fail(fmt::format("{}: {} is '{}', a whole number is needed", where_, what, word));
    return *value;
  }
  std::string_view Word() { return NextWord(rest_); }
  // What is left of the line, which may hold blanks.
  std::string Rest() const {
    const size_t begin = rest_.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return {};
    return std::string(rest_.substr(begin, rest_.find_last_not_of(" \t\r") + 1 - begin));
  }
  const std::string& where() const { return where_; }

 private:
  std::string_view rest_;
  std::string where_;
};

// Lines without comments; a line that is not needed is skipped however long it is.
class LongLines {
 public:
  explicit LongLines(const fs::path& path) : path_(path.string()), stream_(OpenFile(path)) {}

  std::optional<TextFields> Next() {
    while (stream_.peek() != std::char_traits<char>::eof()) {
      ++number_;
      stream_.getline(line_.data(), static_cast<std::streamsize>(line_.size()));
      const std::string where = fmt::format("{}:{}", path_, number_);
      if (stream_.fail() && !stream_.eof()) {
        Fail(fmt::format("{}: has more than {} characters; is it a file of COLMAP?", where,
                         kMaxLine));
      }
      const std::string_view line(line_.data());
      const size_t begin = line.find_first_not_of(" \t\r");
      if (begin != std::string_view::npos && line[begin] != '#') return TextFields(line, where);
    }
    return std::nullopt;
  }
  void Skip() {
    ++number_;
    stream_.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }

 private:
  std::string path_;
  std::ifstream stream_;
  std::vector<char> line_ = std::vector<char>(kMaxLine);
  int number_ = 0;
};

std::map<int64_t, ColmapCamera> ReadCamerasText(const fs::path& path) {
  std::map<int64_t, ColmapCamera> cameras;
  LongLines lines(path);
  while (auto fields = lines.Next()) {
    const int64_t id = fields->Integer("the camera");
    const std::string name(fields->Word());
    ColmapCamera& camera = cameras[id];
    for (const Model& model : kModels) {
      if (model.name == name) camera.model = &model;
    }
    if (camera.model == nullptr) {
      Fail(fmt::format("{}: the camera model {} is not known", fields->where(), name));
    }
    camera.width = Side(static_cast<uint64_t>(fields->Integer("the width")), fields->where());
    camera.height = Side(static_cast<uint64_t>(fields->Integer("the height")), fields->where());
    camera.parameters.clear();
    for (int i = 0; i < camera.model->parameters; ++i) {
      camera.parameters.push_back(fields->Number("a parameter"));
    }
  }
  return cameras;
}

std::vector<ColmapImage> ReadImagesText(const fs::path& path) {
  std::vector<ColmapImage> images;
  LongLines lines(path);
  while (auto fields = lines.Next()) {
    ColmapImage image;
    fields->Integer("the image");
    for (double& value : image.quaternion) value = fields->Number("the quaternion");
    for (double& value : image.translation) value = fields->Number("the translation");
    image.camera = fields->Integer("the camera");
    image.name = fields->Rest();
    if (image.name.empty()) Fail(fields->where() + ": the name of the image is missing");
    images.push_back(std::move(image));
    lines.Skip();  // the points that the image sees; empty where there are none
  }
  return images;
}

// Little-endian values, as all machines have them that this runs on.
class BinaryFields {
 public:
  explicit BinaryFields(const fs::path& path)
      : path_(path.string()), stream_(OpenFile(path)), size_(fs::file_size(path)) {}

  template <class T>
  T Next() {
    T value{};
    stream_.read(reinterpret_cast<char*>(&value), sizeof(T));
    if (!stream_) Truncated();
    return value;
  }
  std::string Name() {
    std::string name;
    for (char c = Next<char>(); c != 0; c = Next<char>()) {
      name += c;
      if (name.size() >= kMaxLine) Fail(path_ + ": a name does not end; is it a file of COLMAP?");
    }
    return name;
  }
  void SkipPoints(uint64_t count) {
    const auto at = static_cast<uint64_t>(stream_.tellg());
    if (count > (size_ - at) / kPointBytes) Truncated();
    stream_.seekg(static_cast<std::streamoff>(count * kPointBytes), std::ios::cur);
  }

 private:
  [[noreturn]] void Truncated() const { Fail(path_ + ": ends too early; copy or export it again"); }

  std::string path_;
  std::ifstream stream_;
  uint64_t size_ = 0;
};

std::map<int64_t, ColmapCamera> ReadCamerasBinary(const fs::path& path) {
  std::map<int64_t, ColmapCamera> cameras;
  BinaryFields fields(path);
  for (auto left = fields.Next<uint64_t>(); left > 0; --left) {
    const int64_t id = fields.Next<uint32_t>();
    const auto model = fields.Next<uint32_t>();
    const std::string where = fmt::format("{}: camera {}", path.string(), id);
    if (model >= kModels.size()) Fail(fmt::format("{}: the model {} is not known", where, model));
    ColmapCamera& camera = cameras[id];
    camera.model = &kModels[model];
    camera.width = Side(fields.Next<uint64_t>(), where);
    camera.height = Side(fields.Next<uint64_t>(), where);
    camera.parameters.clear();
    for (int i = 0; i < camera.model->parameters; ++i) {
      camera.parameters.push_back(fields.Next<double>());
    }
  }
  return cameras;
}

std::vector<ColmapImage> ReadImagesBinary(const fs::path& path) {
  std::vector<ColmapImage> images;
  BinaryFields fields(path);
  for (auto left = fields.Next<uint64_t>(); left > 0; --left) {
    ColmapImage image;
    fields.Next<uint32_t>();  // its number
    for (double& value : image.quaternion) value = fields.Next<double>();
    for (double& value : image.translation) value = fields.Next<double>();
    image.camera = fields.Next<uint32_t>();
    image.name = fields.Name();
    if (image.name.empty()) Fail(path.string() + ": an image has no name");
    fields.SkipPoints(fields.Next<uint64_t>());
    images.push_back(std::move(image));
  }
  return images;
}

bool HoldsModel(const fs::path& folder, const char* extension) {
  return fs::exists(folder / (std::string("cameras") + extension)) &&
         fs::exists(folder / (std::string("images") + extension));
}

// Empty where there is none.
fs::path ModelFolder(const fs::path& folder) {
  for (const fs::path& inside : {folder, folder / "sparse/0", folder / "sparse"}) {
    if (HoldsModel(inside, ".bin") || HoldsModel(inside, ".txt")) return inside;
  }
  return {};
}

ColmapModel ReadModel(const fs::path& model) {
  if (HoldsModel(model, ".bin")) {
    return {ReadCamerasBinary(model / "cameras.bin"), ReadImagesBinary(model / "images.bin")};
  }
  return {ReadCamerasText(model / "cameras.txt"), ReadImagesText(model / "images.txt")};
}

// The one camera that took all images.
const ColmapCamera& CameraOf(const ColmapModel& model, const std::string& where) {
  const ColmapCamera* first = nullptr;
  for (const ColmapImage& image : model.images) {
    const auto camera = model.cameras.find(image.camera);
    if (camera == model.cameras.end()) {
      Fail(fmt::format("{}: image {} has camera {}, which is not there", where, image.name,
                       image.camera));
    }
    if (first == nullptr) first = &camera->second;
    if (first == &camera->second || *first == camera->second) continue;
    Fail(
        fmt::format("{}: image {} has another camera ({}) than the first; CurveFusion takes one "
                    "camera for all images: run COLMAP with --ImageReader.single_camera 1",
                    where, image.name, image.camera));
  }
  if (first == nullptr) Fail(where + ": holds no image with a pose");
  return *first;
}

void UseCamera(const ColmapCamera& given, const std::string& where, Sequence& sequence) {
  if (given.model->order.empty()) {
    Fail(
        fmt::format("{}: the camera model {} is not undone here; run `colmap image_undistorter`, "
                    "which writes images of a PINHOLE camera (and undistort depth in the same way)",
                    where, given.model->name));
  }
  PinholeCamera& camera = sequence.color_camera;
  Distortion& distortion = sequence.color_distortion;
  camera.width = given.width;
  camera.height = given.height;
  const std::map<char, double*> target = {
      {'F', &camera.fx},     {'G', &camera.fy},     {'x', &camera.cx},     {'y', &camera.cy},
      {'1', &distortion.k1}, {'2', &distortion.k2}, {'p', &distortion.p1}, {'q', &distortion.p2}};
  for (size_t i = 0; i < given.parameters.size(); ++i) {
    const char meaning = given.model->order[i];
    if (!std::isfinite(given.parameters[i])) Fail(where + ": a camera parameter is not finite");
    if (meaning == 'f') {
      camera.fx = camera.fy = given.parameters[i];
    } else {
      *target.at(meaning) = given.parameters[i];
    }
  }
  // COLMAP counts from the corner of the top-left pixel.
  camera.cx -= 0.5;
  camera.cy -= 0.5;
  RequirePlausible(camera, where);
  RequireUnfolded(camera, distortion, where);
  sequence.depth_distortion = distortion;
}

std::optional<RigidTransform> PoseOf(const ColmapImage& image, const std::string& where,
                                     const FindingHandler& on_finding) {
  const auto& [w, x, y, z] = image.quaternion;
  const auto pose = RigidFromQuaternion(Eigen::Quaterniond(w, x, y, z),
                                        Eigen::Map<const Vec3>(image.translation.data()),
                                        fmt::format("{}: image {}", where, image.name), on_finding);
  if (!pose) return std::nullopt;
  return pose->inverse();
}

void AddImages(const ColmapModel& model, const fs::path& folder, const std::string& where,
               bool with_poses, const FindingHandler& on_finding, Sequence& sequence) {
  for (const ColmapImage& image : model.images) {
    const fs::path color = ColorFolder(folder) / image.name;
    const fs::path depth = (folder / "depth" / image.name).replace_extension(".png");
    const auto pose = with_poses ? PoseOf(image, where, on_finding) : RigidTransform::Identity();
    std::error_code unreadable;  // such as a name that is too long
    const bool has_depth = !sequence.has_depth || fs::exists(depth, unreadable);
    if (!has_depth || !fs::exists(color, unreadable)) {
      ++sequence.frames_without_partner;
    } else if (!pose) {
      ++sequence.frames_without_pose;
    } else {
      sequence.frames.push_back(
          {FrameName(color), 0, *pose, color, sequence.has_depth ? depth : fs::path()});
    }
  }
  NumberByColorPath(sequence);
}

Sequence ReadWith(const fs::path& folder, bool with_poses, const FindingHandler& on_finding) {
  const fs::path model_folder = ModelFolder(folder);
  const std::string where = model_folder.string();
  if (!fs::is_directory(ColorFolder(folder))) {
    Fail(fmt::format(
        "{}: is missing; a COLMAP model needs the colour images in images/ and, where there is "
        "depth, for each a 16-bit depth image of the same name, as PNG in mm, in depth/",
        ColorFolder(folder).string()));
  }
  const ColmapModel model = ReadModel(model_folder);
  Sequence sequence;
  sequence.depth_scale = kMillimetreUnits;
  sequence.has_depth = fs::is_directory(folder / "depth");
  UseCamera(CameraOf(model, where), where, sequence);
  AddImages(model, folder, where, with_poses, on_finding, sequence);
  sequence.depth_camera =
      sequence.frames.empty() || !sequence.has_depth
          ? sequence.color_camera
          : RegisteredDepthCamera(sequence.color_camera, sequence.frames.front().depth_path);
  if (with_poses && sequence.has_depth) {
    on_finding({Severity::kWarning,
                fmt::format("{}: COLMAP does not know the scale of its poses, depth is in metres; "
                            "`curvefusion check` compares them, and `check --repair DIR` writes a "
                            "copy in metres where they differ",
                            where),
                "colmap-scale"});
  }
  return sequence;
}

}  // namespace

bool HasColmapModel(const fs::path& folder) { return !ModelFolder(folder).empty(); }

Sequence ReadColmap(const fs::path& folder, const FindingHandler& on_finding) {
  return ReadWith(folder, true, on_finding);
}

Sequence ReadColmapImages(const fs::path& folder, const FindingHandler& on_finding) {
  return ReadWith(folder, false, on_finding);
}

}  // namespace curvefusion
