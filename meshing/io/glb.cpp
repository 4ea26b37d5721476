#include <fmt/format.h>
#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "kernel/error.h"
#include "kernel/json_input.h"
#include "meshing/corner_normals.h"
#include "meshing/io/mesh_formats.h"
#include "meshing/watertight.h"

namespace curvefusion {

namespace {

// Facets of tubes and their domes turn by 22.5 degrees (16 sides); what turns by more is a seam
// between tubes, or a kink of the wire.
constexpr double kCreaseAngle = 30 * std::numbers::pi / 180;

// A mesh as a graphics card takes it: one normal a vertex, so vertices on creases are repeated.
struct ShadedMesh {
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;
  std::vector<uint32_t> indices;
};

ShadedMesh Shade(const TriangleMesh& mesh, const CornerNormals& shading) {
  ShadedMesh shaded;
  shaded.normals = shading.normals;
  shaded.positions.resize(shading.normals.size());
  for (size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (size_t k = 0; k < 3; ++k) {
      const int index = shading.of_corner[f][k];
      shaded.positions[index] = mesh.vertices[mesh.triangles[f][k]];
      shaded.indices.push_back(static_cast<uint32_t>(index));
    }
  }
  return shaded;
}

template <class T>
int AddView(const std::vector<T>& values, int target, tinygltf::Model& model) {
  std::vector<unsigned char>& data = model.buffers[0].data;
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = data.size();
  view.byteLength = values.size() * sizeof(T);
  view.target = target;
  const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
  data.insert(data.end(), bytes, bytes + view.byteLength);
  model.bufferViews.push_back(view);
  return static_cast<int>(model.bufferViews.size()) - 1;
}

int AddAccessor(int view, int component_type, int type, size_t count, tinygltf::Model& model) {
  tinygltf::Accessor accessor;
  accessor.bufferView = view;
  accessor.componentType = component_type;
  accessor.type = type;
  accessor.count = count;
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size()) - 1;
}

int AddVectors(const std::vector<Vec3f>& vectors, tinygltf::Model& model) {
  return AddAccessor(AddView(vectors, TINYGLTF_TARGET_ARRAY_BUFFER, model),
                     TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, vectors.size(), model);
}

tinygltf::Primitive AddPrimitive(const ShadedMesh& shaded, tinygltf::Model& model) {
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = 0;
  const int positions = AddVectors(shaded.positions, model);
  Eigen::AlignedBox3d box;
  for (const Vec3f& v : shaded.positions) box.extend(v.cast<double>());
  model.accessors[positions].minValues = {box.min().x(), box.min().y(), box.min().z()};
  model.accessors[positions].maxValues = {box.max().x(), box.max().y(), box.max().z()};
  primitive.attributes = {{"POSITION", positions}, {"NORMAL", AddVectors(shaded.normals, model)}};
  primitive.indices = AddAccessor(
      AddView(shaded.indices, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, model),
      TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, shaded.indices.size(), model);
  return primitive;
}

// Grey and matt: the default material of glTF is a mirror.
tinygltf::Material PlainMaterial() {
  tinygltf::Material material;
  material.name = "wire";
  material.pbrMetallicRoughness.baseColorFactor = {0.6, 0.62, 0.65, 1.0};
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.pbrMetallicRoughness.roughnessFactor = 0.6;
  return material;
}

// Reads the meshes of the scene of a glTF model.
class GlbReader {
 public:
  GlbReader(const tinygltf::Model& model, const std::string& name) : model_(model), name_(name) {}

  TriangleMesh Read() {
    if (model_.scenes.empty()) {
      for (const tinygltf::Mesh& mesh : model_.meshes) AddMesh(mesh, AffineTransform::Identity());
    } else {
      AddNodes(At(model_.scenes, std::max(model_.defaultScene, 0)).nodes);
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", name_, what));
  }

  template <class T>
  const T& At(const std::vector<T>& list, int index) const {
    if (index < 0 || index >= static_cast<int>(list.size())) Fail("an index is out of range");
    return list[index];
  }

  static AffineTransform TransformOf(const tinygltf::Node& node) {
    AffineTransform T = AffineTransform::Identity();
    if (node.matrix.size() == 16) {
      T.matrix() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
      return T;
    }
    if (node.translation.size() == 3) T.translate(Vec3(node.translation.data()));
    if (node.rotation.size() == 4) T.rotate(Eigen::Quaterniond(node.rotation.data()));
    if (node.scale.size() == 3) T.scale(Vec3(node.scale.data()));
    return T;
  }

  // Nodes and what they contain, in depth first order; they must be trees, however deep.
  void AddNodes(const std::vector<int>& roots) {
    std::vector<std::pair<int, AffineTransform>> open;
    const auto add = [&open](const std::vector<int>& nodes, const AffineTransform& T_world_parent) {
      for (auto node = nodes.rbegin(); node != nodes.rend(); ++node)
        open.emplace_back(*node, T_world_parent);
    };
    std::vector<char> visited(model_.nodes.size(), false);
    add(roots, AffineTransform::Identity());
    while (!open.empty()) {
      const auto [index, T_world_parent] = open.back();
      open.pop_back();
      const tinygltf::Node& node = At(model_.nodes, index);
      if (visited[index]) Fail("a node is contained twice");
      visited[index] = true;
      const AffineTransform T_world_node = T_world_parent * TransformOf(node);
      if (node.mesh >= 0) AddMesh(At(model_.meshes, node.mesh), T_world_node);
      add(node.children, T_world_node);
    }
  }

  void AddMesh(const tinygltf::Mesh& mesh, const AffineTransform& T_world_mesh) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      if (primitive.mode != TINYGLTF_MODE_TRIANGLES) Fail("only triangles are read");
      AddPositions(primitive, T_world_mesh);
    }
  }

  // The bytes of an accessor's elements and how far apart they are.
  struct Elements {
    const unsigned char* data;
    size_t stride;
  };
  Elements ElementsOf(const tinygltf::Accessor& accessor) const {
    if (accessor.sparse.isSparse) Fail("sparse accessors are not read");
    const tinygltf::BufferView& view = At(model_.bufferViews, accessor.bufferView);
    const std::vector<unsigned char>& buffer = At(model_.buffers, view.buffer).data;
    const int stride = accessor.ByteStride(view);
    const int size = tinygltf::GetComponentSizeInBytes(accessor.componentType) *
                     tinygltf::GetNumComponentsInType(accessor.type);
    if (stride < size || size <= 0 || accessor.count == 0 || accessor.count > buffer.size()) {
      Fail("an accessor is damaged or empty");
    }
    const size_t extent = (accessor.count - 1) * stride + size;
    if (accessor.byteOffset > view.byteLength || extent > view.byteLength - accessor.byteOffset ||
        view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset) {
      Fail("an accessor reaches beyond its buffer");
    }
    return {buffer.data() + view.byteOffset + accessor.byteOffset, static_cast<size_t>(stride)};
  }

  void AddPositions(const tinygltf::Primitive& primitive, const AffineTransform& T_world_mesh) {
    const auto found = primitive.attributes.find("POSITION");
    if (found == primitive.attributes.end()) Fail("a mesh has no positions");
    const tinygltf::Accessor& accessor = At(model_.accessors, found->second);
    if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT ||
        accessor.type != TINYGLTF_TYPE_VEC3) {
      Fail("only positions of three float numbers are read");
    }
    const Elements elements = ElementsOf(accessor);
    if (accessor.count > std::numeric_limits<int>::max() - result_.vertices.size()) {
      Fail("the mesh has too many vertices");
    }
    const int first = static_cast<int>(result_.vertices.size());
    for (size_t i = 0; i < accessor.count; ++i) {
      Vec3f v;
      std::memcpy(v.data(), elements.data + i * elements.stride, sizeof(v));
      result_.vertices.push_back((T_world_mesh * v.cast<double>()).cast<float>());
    }
    std::vector<uint32_t> corners = Corners(primitive, accessor.count);
    // A mirroring transform turns the triangles inside out; glTF turns them back.
    const bool mirrored = T_world_mesh.linear().determinant() < 0;
    for (size_t i = 0; i + 2 < corners.size(); i += 3) {
      if (mirrored) std::swap(corners[i], corners[i + 1]);
      result_.triangles.push_back({first + static_cast<int>(corners[i]),
                                   first + static_cast<int>(corners[i + 1]),
                                   first + static_cast<int>(corners[i + 2])});
    }
  }

  // The vertices of all corners, within the primitive.
  std::vector<uint32_t> Corners(const tinygltf::Primitive& primitive, size_t vertex_count) const {
    std::vector<uint32_t> corners;
    if (primitive.indices < 0) {
      for (size_t i = 0; i < vertex_count; ++i) corners.push_back(static_cast<uint32_t>(i));
      return corners;
    }
    const tinygltf::Accessor& accessor = At(model_.accessors, primitive.indices);
    const Elements elements = ElementsOf(accessor);
    const size_t size = std::min<size_t>(
        sizeof(uint32_t),
        static_cast<size_t>(tinygltf::GetComponentSizeInBytes(accessor.componentType)));
    for (size_t i = 0; i < accessor.count; ++i) {
      uint32_t index = 0;  // little-endian, as this machine and the file are
      std::memcpy(&index, elements.data + i * elements.stride, size);
      if (index >= vertex_count) Fail("a triangle uses a vertex that is not there");
      corners.push_back(index);
    }
    return corners;
  }

  const tinygltf::Model& model_;
  const std::string& name_;
  TriangleMesh result_;
};

// What keeps a file from being read, in other words than those of the library. Throws for a part
// that is not valid JSON.
std::string Defect(const std::string& bytes, const std::string& name) {
  constexpr size_t kHeader = 20;  // magic, version, length; length and type of the JSON part
  const auto number = [&bytes](size_t at) {
    uint32_t value = 0;  // little-endian, as this machine and the file are
    std::memcpy(&value, bytes.data() + at, sizeof(value));
    return value;
  };
  if (!bytes.starts_with("glTF")) return "is not a binary glTF file";
  if (bytes.size() < kHeader) return "is truncated";
  if (number(4) != 2) {
    return fmt::format("is of glTF version {}; only version 2 is read", number(4));
  }
  if (number(8) > bytes.size() || number(12) > bytes.size() - kHeader) {
    return fmt::format("is truncated or damaged: it should have {} bytes and has {}", number(8),
                       bytes.size());
  }
  ParseJson(bytes.substr(kHeader, number(12)), name);
  return "its description of the meshes is damaged or incomplete; export the file again";
}

}  // namespace

void WriteGlb(const TriangleMesh& mesh, std::ostream& stream) {
  WriteShadedGlb(mesh, ComputeCornerNormals(mesh, kCreaseAngle), stream);
}

void WriteShadedGlb(const TriangleMesh& mesh, const CornerNormals& normals, std::ostream& stream) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "CurveFusion";
  model.defaultScene = 0;
  model.scenes.emplace_back();
  if (!mesh.triangles.empty()) {
    model.buffers.emplace_back();
    model.materials.push_back(PlainMaterial());
    tinygltf::Mesh tubes;
    tubes.name = "tubes";
    tubes.primitives.push_back(AddPrimitive(Shade(mesh, normals), model));
    model.meshes.push_back(std::move(tubes));
    tinygltf::Node node;
    node.mesh = 0;
    model.nodes.push_back(node);
    model.scenes[0].nodes = {0};
  }
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true)) {
    stream.setstate(std::ios::failbit);
  }
}

TriangleMesh ReadGlb(std::istream& stream, const std::string& name) {
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  tinygltf::TinyGLTF loader;
  // Textures do not matter here.
  loader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int,
                           const unsigned char*, int, void*) { return true; },
                        nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const bool loaded = loader.LoadBinaryFromMemory(
      &model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
      static_cast<unsigned int>(bytes.size()), std::filesystem::path(name).parent_path().string());
  if (!loaded) throw Error(ErrorKind::kBadInput, name + ": " + Defect(bytes, name));
  return WeldVertices(GlbReader(model, name).Read());
}

}  // namespace curvefusion
