#include <Model/COM/NMR_DLLInterfaces.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <new>
#include <vector>

#include "kernel/error.h"
#include "meshing/io/mesh_formats.h"

namespace curvefusion {

namespace {

using NMR::PLib3MFBase;

// An object of lib3MF, released at the end of its scope. Its functions return 0 for success.
class Handle {
 public:
  explicit Handle(const std::string& file) : file_(file) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (object_) NMR::lib3mf_release(object_);
  }

  PLib3MFBase* get() const { return object_; }
  PLib3MFBase** out() { return &object_; }

  void Require(LIB3MFRESULT result, ErrorKind kind = ErrorKind::kBadInput) const {
    if (result == 0) return;
    // The library's messages speak of its own classes.
    const char* what =
        kind == ErrorKind::kBadInput ? "is damaged, or no 3MF file" : "cannot be made";
    throw Error(kind, fmt::format("{}: {} (error {:#x} of lib3MF)", file_, what,
                                  static_cast<uint32_t>(result)));
  }

 private:
  const std::string& file_;
  PLib3MFBase* object_ = nullptr;
};

// What lib3MF takes at once to read a file, at least.
constexpr size_t kReaderBytes = 64 * 1024;

// lib3MF calls a file damaged for which it has found no memory. Compilers may leave out a new
// expression that nothing uses, but no call of the operator.
void RequireMemory(size_t bytes) { ::operator delete(::operator new(bytes)); }

AffineTransform TransformOf(const Handle& item) {
  AffineTransform T = AffineTransform::Identity();
  BOOL has_transform = false;
  item.Require(NMR::lib3mf_builditem_hasobjecttransform(item.get(), &has_transform));
  if (!has_transform) return T;
  NMR::MODELTRANSFORM fields;
  item.Require(NMR::lib3mf_builditem_getobjecttransform(item.get(), &fields));
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) T(row, column) = fields.m_fFields[row][column];
  }
  return T;
}

void AppendObject(const Handle& object, const AffineTransform& T_world_object, TriangleMesh& mesh) {
  DWORD vertex_count = 0;
  DWORD triangle_count = 0;
  object.Require(NMR::lib3mf_meshobject_getvertexcount(object.get(), &vertex_count));
  object.Require(NMR::lib3mf_meshobject_gettrianglecount(object.get(), &triangle_count));
  std::vector<NMR::MODELMESHVERTEX> vertices(vertex_count);
  std::vector<NMR::MODELMESHTRIANGLE> triangles(triangle_count);
  object.Require(NMR::lib3mf_meshobject_getvertices(object.get(), vertices.data(), vertex_count,
                                                    &vertex_count));
  object.Require(NMR::lib3mf_meshobject_gettriangleindices(object.get(), triangles.data(),
                                                           triangle_count, &triangle_count));
  const int first = static_cast<int>(mesh.vertices.size());
  for (const NMR::MODELMESHVERTEX& v : vertices) {
    const Vec3 p(v.m_fPosition[0], v.m_fPosition[1], v.m_fPosition[2]);
    mesh.vertices.push_back((T_world_object * p).cast<float>());
  }
  for (const NMR::MODELMESHTRIANGLE& t : triangles) {
    mesh.triangles.push_back({first + static_cast<int>(t.m_nIndices[0]),
                              first + static_cast<int>(t.m_nIndices[1]),
                              first + static_cast<int>(t.m_nIndices[2])});
  }
}

// How lib3MF writes and seeks; `user` is the stream. They always report success (0): lib3MF would
// end the program, and the state of the stream tells of failures.
uint32_t WriteBytes(unsigned char* data, uint32_t count, void* user) {
  static_cast<std::ostream*>(user)->write(reinterpret_cast<const char*>(data),
                                          static_cast<std::streamsize>(count));
  return 0;
}

uint32_t Seek(uint64_t position, void* user) {
  static_cast<std::ostream*>(user)->seekp(static_cast<std::streamoff>(position));
  return 0;
}

}  // namespace

void Write3mf(const TriangleMesh& mesh, std::ostream& stream) {
  const std::string name = "3MF file";
  Handle model(name), object(name), item(name), writer(name);
  const auto require = [&](LIB3MFRESULT result) { model.Require(result, ErrorKind::kResource); };
  require(NMR::lib3mf_createmodel(model.out()));
  require(NMR::lib3mf_model_setunit(model.get(), NMR::MODELUNIT_MILLIMETER));
  require(NMR::lib3mf_model_addmeshobject(model.get(), object.out()));
  std::vector<NMR::MODELMESHVERTEX> vertices;
  for (const Vec3f& v : mesh.vertices) vertices.push_back({{v.x(), v.y(), v.z()}});
  std::vector<NMR::MODELMESHTRIANGLE> triangles;
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles.push_back({{static_cast<DWORD>(a), static_cast<DWORD>(b), static_cast<DWORD>(c)}});
  }
  require(NMR::lib3mf_meshobject_setgeometry(object.get(), vertices.data(),
                                             static_cast<DWORD>(vertices.size()), triangles.data(),
                                             static_cast<DWORD>(triangles.size())));
  require(NMR::lib3mf_object_setnameutf8(object.get(), "tubes"));
  require(NMR::lib3mf_model_addbuilditem(model.get(), object.get(), nullptr, item.out()));
  require(NMR::lib3mf_model_querywriter(model.get(), "3mf", writer.out()));
  require(NMR::lib3mf_writer_writetocallback(writer.get(), reinterpret_cast<void*>(&WriteBytes),
                                             reinterpret_cast<void*>(&Seek), &stream));
}

TriangleMesh Read3mf(std::istream& stream, const std::string& name) {
  std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
  Handle model(name), reader(name), items(name);
  model.Require(NMR::lib3mf_createmodel(model.out()));
  model.Require(NMR::lib3mf_model_queryreader(model.get(), "3mf", reader.out()));
  const LIB3MFRESULT result = NMR::lib3mf_reader_readfrombuffer(
      reader.get(), reinterpret_cast<BYTE*>(bytes.data()), bytes.size());
  if (result != 0) RequireMemory(std::max(bytes.size(), kReaderBytes));
  reader.Require(result);
  model.Require(NMR::lib3mf_model_getbuilditems(model.get(), items.out()));
  TriangleMesh mesh;
  while (true) {
    BOOL has_next = false;
    items.Require(NMR::lib3mf_builditemiterator_movenext(items.get(), &has_next));
    if (!has_next) return mesh;
    Handle item(name), object(name);
    items.Require(NMR::lib3mf_builditemiterator_getcurrent(items.get(), item.out()));
    item.Require(NMR::lib3mf_builditem_getobjectresource(item.get(), object.out()));
    BOOL is_mesh = false;
    object.Require(NMR::lib3mf_object_ismeshobject(object.get(), &is_mesh));
    if (!is_mesh) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("{}: holds an assembly of parts; only plain meshes are read", name));
    }
    AppendObject(object, TransformOf(item), mesh);
  }
}

}  // namespace curvefusion
