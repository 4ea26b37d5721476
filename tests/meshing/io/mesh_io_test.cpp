#include "meshing/io/mesh_io.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "kernel/error.h"
#include "meshing/corner_normals.h"
#include "meshing/surface_mesh.h"
#include "meshing/tubes.h"
#include "meshing/watertight.h"
#include "tests/error_message.h"
#include "tests/file_contents.h"
#include "tests/meshing/tube_graphs.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

class MeshIo : public testing::Test {
 protected:
  void WriteText(const fs::path& path, const std::string& text) const {
    std::ofstream(path, std::ios::binary) << text;
  }

  const TemporaryFolder folder_{"mesh_io"};
};

TriangleMesh LatticeMesh() {
  return ToTriangleMesh(BuildTubes(LatticeGraph(2, 0.03, 0.0025), {}).surface);
}

TEST_F(MeshIo, EveryFormatGivesBackEveryCoordinate) {
  const TriangleMesh mesh = LatticeMesh();
  for (const char* name : {"a.ply", "a.obj", "a.stl", "a.glb", "B.PLY"}) {
    WriteMesh(folder_ / name, mesh, {});
    const TriangleMesh back = ReadMesh(folder_ / name);
    ASSERT_EQ(back.triangles.size(), mesh.triangles.size()) << name;
    EXPECT_EQ(back.vertices.size(), mesh.vertices.size()) << name;
    for (size_t f = 0; f < mesh.triangles.size(); ++f) {
      for (size_t k = 0; k < 3; ++k) {
        ASSERT_EQ(back.vertices[back.triangles[f][k]], mesh.vertices[mesh.triangles[f][k]]) << name;
      }
    }
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 5);  // and no temporary left
}

TEST_F(MeshIo, MillimetresScaleByAThousandAndStayWatertight) {
  const TriangleMesh mesh = LatticeMesh();
  WriteMesh(folder_ / "a.stl", mesh, {MeshUnit::kMillimetres, true});
  const WatertightReport in_mm = ExamineMesh(ReadMesh(folder_ / "a.stl"));
  EXPECT_TRUE(in_mm.IsWatertight()) << in_mm.Defects();
  // Coordinates carry seven digits.
  EXPECT_NEAR(in_mm.volume / ExamineMesh(mesh).volume, 1e9, 1e9 * 1e-5);
}

TEST_F(MeshIo, ThreeMfIsInMillimetresOfSixDecimals) {
  const TriangleMesh mesh = LatticeMesh();
  EXPECT_EQ(DefaultUnit("a.3mf"), MeshUnit::kMillimetres);
  EXPECT_EQ(OnlyUnit("a.3MF"), MeshUnit::kMillimetres);
  EXPECT_EQ(OnlyUnit("a.stl"), std::nullopt);
  EXPECT_THROW(WriteMesh(folder_ / "a.3mf", mesh, {MeshUnit::kMetres}), Error);
  EXPECT_THROW(WriteMesh(folder_ / "a.glb", mesh, {MeshUnit::kMillimetres}), Error);
  WriteMesh(folder_ / "a.3mf", mesh, {});
  const TriangleMesh back = ReadMesh(folder_ / "a.3mf");
  ASSERT_EQ(back.triangles, mesh.triangles);
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    // One step of the last decimal, and some of float32 (2e-6) at 30 mm.
    EXPECT_LT((back.vertices[v] - 1000 * mesh.vertices[v]).norm(), 1e-6 + 1e-5);
  }
  EXPECT_EQ(ExamineMesh(back).Defects(), "");
}

TEST_F(MeshIo, GlbHasNormalsThatBreakAtSeams) {
  SkeletonGraph cross;
  AddCurve(cross, {{-0.03, 0, 0}, {0.03, 0, 0}}, 0.0025);
  AddCurve(cross, {{0, -0.03, 0}, {0, 0.03, 0}}, 0.0025);
  const TriangleMesh mesh = ToTriangleMesh(BuildTubes(cross, {}).surface);
  const CornerNormals shading = ComputeCornerNormals(mesh, 0.8);
  // Vertices on the seam have two normals or more, all others one.
  EXPECT_GT(shading.normals.size(), mesh.vertices.size() + 20);
  EXPECT_LT(shading.normals.size(), mesh.vertices.size() + 200);
  for (size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (size_t k = 0; k < 3; ++k) {
      const Vec3f& p = mesh.vertices[mesh.triangles[f][k]];
      const Vec3f& n = shading.normals[shading.of_corner[f][k]];
      if (std::abs(p.x()) < 0.005f || std::abs(p.x()) > 0.029f || std::abs(p.y()) > 0.003f)
        continue;
      // On the plain side of the tube along x normals are radial, up to a facet's half turn.
      EXPECT_GT(n.dot(Vec3f(0, p.y(), p.z()).normalized()), std::cos(M_PI / 16));
    }
  }
}

TEST_F(MeshIo, ReadsGlbOfOtherPrograms) {
  // A triangle of a node that is moved and mirrored, without indices.
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.buffers.emplace_back();
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const auto* bytes = reinterpret_cast<const unsigned char*>(positions.data());
  model.buffers[0].data.assign(bytes, bytes + 36);
  model.bufferViews.emplace_back();
  model.bufferViews[0].buffer = 0;
  model.bufferViews[0].byteLength = 36;
  model.accessors.emplace_back();
  model.accessors[0].bufferView = 0;
  model.accessors[0].componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  model.accessors[0].type = TINYGLTF_TYPE_VEC3;
  model.accessors[0].count = 3;
  model.meshes.emplace_back();
  model.meshes[0].primitives.emplace_back();
  model.meshes[0].primitives[0].mode = TINYGLTF_MODE_TRIANGLES;
  model.meshes[0].primitives[0].attributes["POSITION"] = 0;
  model.nodes.resize(2);
  model.nodes[0].children = {1};
  model.nodes[0].translation = {0, 0, 5};
  model.nodes[1].scale = {-2, 1, 1};
  model.nodes[1].mesh = 0;
  model.scenes.emplace_back();
  model.scenes[0].nodes = {0};
  const std::string path = (folder_ / "a.glb").string();
  ASSERT_TRUE(tinygltf::TinyGLTF().WriteGltfSceneToFile(&model, path, true, true, false, true));
  const TriangleMesh mesh = ReadMesh(path);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.vertices[mesh.triangles[0][0]], Vec3f(-2, 0, 5));
  EXPECT_EQ(mesh.vertices[mesh.triangles[0][2]], Vec3f(0, 1, 5));

  model.accessors[0].count = 4;  // one more than there is
  ASSERT_TRUE(tinygltf::TinyGLTF().WriteGltfSceneToFile(&model, path, true, true, false, true));
  EXPECT_THROW(ReadMesh(path), Error);
  model.accessors[0].count = 3;
  model.nodes[1].children = {0};  // a circle
  ASSERT_TRUE(tinygltf::TinyGLTF().WriteGltfSceneToFile(&model, path, true, true, false, true));
  EXPECT_THROW(ReadMesh(path), Error);
}

TEST_F(MeshIo, AdmeshFindsNothingToRepair) {
  if (std::system("command -v admesh > /dev/null") != 0) GTEST_SKIP() << "admesh is not installed";
  WriteMesh(folder_ / "a.stl", LatticeMesh(), {MeshUnit::kMillimetres, true});
  const fs::path log = folder_ / "log";
  const std::string command =
      "admesh '" + (folder_ / "a.stl").string() + "' > '" + log.string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string text = FileText(log);
  for (const char* repair : {"Edges fixed", "Facets removed", "Facets added", "Facets reversed",
                             "Backwards edges", "Normals fixed", "Degenerate facets"}) {
    const size_t at = text.find(repair);
    ASSERT_NE(at, std::string::npos) << repair;
    const size_t colon = text.find(':', at);
    EXPECT_EQ(std::atoi(text.c_str() + colon + 1), 0) << repair << "\n" << text;
  }
}

TEST_F(MeshIo, NothingAppearsForAMeshThatIsNotWatertight) {
  TriangleMesh mesh = LatticeMesh();
  mesh.triangles.pop_back();
  EXPECT_THROW(WriteMesh(folder_ / "a.ply", mesh, {}), Error);
  EXPECT_TRUE(fs::is_empty(folder_));
  WriteMesh(folder_ / "a.ply", mesh, {MeshUnit::kMetres, false});  // a scan's volume is open
  EXPECT_EQ(ReadMesh(folder_ / "a.ply").triangles.size(), mesh.triangles.size());
}

TEST_F(MeshIo, AnEmptyMeshIsNotWatertightButCanBeWritten) {
  EXPECT_THROW(WriteMesh(folder_ / "a.ply", {}, {}), Error);
  WriteMesh(folder_ / "a.ply", {}, {MeshUnit::kMetres, false});
  EXPECT_TRUE(ReadMesh(folder_ / "a.ply").triangles.empty());
}

TEST_F(MeshIo, RefusesOtherExtensionsAndMissingFiles) {
  EXPECT_THROW(WriteMesh(folder_ / "a.off", LatticeMesh(), {}), Error);
  EXPECT_THROW(ReadMesh(folder_ / "none.ply"), Error);
  EXPECT_THROW(WriteMesh(folder_ / "no_folder" / "a.ply", LatticeMesh(), {}), Error);
}

TEST_F(MeshIo, ReadsAsciiPlyWithFurtherProperties) {
  WriteText(
      folder_ / "a.ply",
      "ply\r\nformat ascii 1.0\ncomment made by hand\nelement vertex 3\nproperty double x\n"
      "property double y\nproperty double z\nproperty uchar red\nelement face 1\n"
      "property list uchar uint vertex_index\nproperty float quality\nelement camera 1\n"
      "property float focal\nend_header\n0 0 0 255\n1 0 0 255\n0 1.5 0 255\n3 0 1 2 0.5\n7\n");
  const TriangleMesh mesh = ReadMesh(folder_ / "a.ply");
  ASSERT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.vertices[2], Vec3f(0, 1.5f, 0));
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<int, 3>>{{0, 1, 2}}));
}

TEST_F(MeshIo, ReadsObjWithTexturesAndBackwardIndices) {
  WriteText(folder_ / "a.obj",
            "# by hand\no thing\nv 0 0 0\nv 1 0 0\nv 0 1e-1 0\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\n"
            "f -3 -2 -1\n");
  const TriangleMesh mesh = ReadMesh(folder_ / "a.obj");
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 1, 2}}));
  EXPECT_EQ(mesh.vertices[2].y(), 0.1f);
}

TEST_F(MeshIo, DamagedFilesAreErrors) {
  const TriangleMesh mesh = LatticeMesh();
  for (const char* name : {"a.ply", "a.stl", "a.glb", "a.3mf"}) {
    WriteMesh(folder_ / name, mesh, {});
    const auto size = fs::file_size(folder_ / name);
    for (const double part : {0.0, 0.001, 0.3, 0.9}) {
      fs::resize_file(folder_ / name, static_cast<uintmax_t>(part * static_cast<double>(size)));
      EXPECT_THROW(ReadMesh(folder_ / name), Error) << name << " cut to " << part;
      WriteMesh(folder_ / name, mesh, {});
    }
  }
  for (const char* text :
       {"not a ply", "ply\nformat binary_big_endian 1.0\nend_header\n",
        "ply\nformat ascii 1.0\nelement vertex 99999999999\nend_header\n",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nelement face 1\nproperty list "
        "uchar int vertex_indices\nend_header\n1\n4 0 0 0 0\n",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nelement face 1\nproperty list "
        "uchar int vertex_indices\nend_header\n1\n3 0 0 1\n",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nelement face 1\nproperty list "
        "uchar double vertex_indices\nend_header\n1\n3 0 0 1e300\n",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty list int float x\nend_header\n-1\n",
        "ply\nformat ascii 1.0\nelement vertex 2000000000\nend_header\n",
        "ply\nformat ascii 1.0\nproperty float x\n", "ply\nformat ascii 1.0\n"}) {
    WriteText(folder_ / "b.ply", text);
    EXPECT_THROW(ReadMesh(folder_ / "b.ply"), Error) << text;
  }
  for (const char* text :
       {"v 1 2\n", "v 0 0 0\nf 1 1 2\n", "v 0 0 0\nf 1 1 1 1\n", "f a b c\n", "v 0 0 nan\n"}) {
    WriteText(folder_ / "b.obj", text);
    EXPECT_THROW(ReadMesh(folder_ / "b.obj"), Error) << text;
  }
}

// Readers' libraries have words of their own.
TEST_F(MeshIo, DamagedFilesAreToldInPlainWords) {
  const auto message = [&](const char* name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return MessageOf(ErrorKind::kBadInput, [&] { ReadMesh(folder_ / name); })
        .substr((folder_ / name).string().size());
  };
  const std::string json = "{\"asset\": x}    ";
  const auto header = [&](char version, char length) {
    return std::string("glTF") + version + std::string(3, '\0') + length + std::string(3, '\0') +
           static_cast<char>(json.size()) + std::string("\0\0\0JSON", 7);
  };
  EXPECT_EQ(message("a.glb", "text"), ": is not a binary glTF file");
  EXPECT_EQ(message("a.glb", header(1, 36) + json),
            ": is of glTF version 1; only version 2 is read");
  EXPECT_EQ(message("a.glb", header(2, 99) + json),
            ": is truncated or damaged: it should have 99 bytes and has 36");
  EXPECT_EQ(message("a.glb", header(2, 36) + json).find(": not valid JSON: line 1, column 11"), 0u);
  EXPECT_EQ(message("a.3mf", "text").find(": is damaged, or no 3MF file"), 0u);
}

}  // namespace
}  // namespace curvefusion
