#include "meshing/mesh_io.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "kernel/error.h"
#include "meshing/surface_mesh.h"
#include "meshing/tubes.h"
#include "meshing/watertight.h"
#include "tests/meshing/tube_graphs.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

class MeshIo : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("curvefusion_mesh_io_" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void WriteText(const fs::path& path, const std::string& text) const {
    std::ofstream(path, std::ios::binary) << text;
  }

  fs::path folder_;
};

TriangleMesh LatticeMesh() {
  return ToTriangleMesh(BuildTubes(LatticeGraph(2, 0.03, 0.0025), {}).surface);
}

TEST_F(MeshIo, EveryFormatGivesBackEveryCoordinate) {
  const TriangleMesh mesh = LatticeMesh();
  for (const char* name : {"a.ply", "a.obj", "a.stl", "B.PLY"}) {
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
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 4);  // and no temporary left
}

TEST_F(MeshIo, MillimetresScaleByAThousandAndStayWatertight) {
  const TriangleMesh mesh = LatticeMesh();
  WriteMesh(folder_ / "a.stl", mesh, {MeshUnit::kMillimetres, true});
  const WatertightReport in_mm = ExamineMesh(ReadMesh(folder_ / "a.stl"));
  EXPECT_TRUE(in_mm.IsWatertight()) << in_mm.Defects();
  // Coordinates carry seven digits.
  EXPECT_NEAR(in_mm.volume / ExamineMesh(mesh).volume, 1e9, 1e9 * 1e-5);
}

TEST_F(MeshIo, AdmeshFindsNothingToRepair) {
  if (std::system("command -v admesh > /dev/null") != 0) GTEST_SKIP() << "admesh is not installed";
  WriteMesh(folder_ / "a.stl", LatticeMesh(), {MeshUnit::kMillimetres, true});
  const fs::path log = folder_ / "log";
  const std::string command =
      "admesh '" + (folder_ / "a.stl").string() + "' > '" + log.string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::stringstream text;
  text << std::ifstream(log).rdbuf();
  for (const char* repair : {"Edges fixed", "Facets removed", "Facets added", "Facets reversed",
                             "Backwards edges", "Normals fixed", "Degenerate facets"}) {
    const size_t at = text.str().find(repair);
    ASSERT_NE(at, std::string::npos) << repair;
    const size_t colon = text.str().find(':', at);
    EXPECT_EQ(std::atoi(text.str().c_str() + colon + 1), 0) << repair << "\n" << text.str();
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
  for (const char* name : {"a.ply", "a.stl"}) {
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

}  // namespace
}  // namespace curvefusion
