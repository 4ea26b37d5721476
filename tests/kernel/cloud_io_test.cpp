#include "kernel/cloud_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <limits>

#include "kernel/error.h"
#include "tests/error_message.h"
#include "tests/test_data.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

class CloudFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = fs::path(testing::TempDir()) / (std::string("cloud_io_") + test->name() + ".cloud");
  }
  void TearDown() override { fs::remove(path_); }

  ObservedPoints Read(const std::string& content) {
    std::ofstream(path_, std::ios::binary) << content;
    return ReadCloud(path_);
  }

  // What is wrong with a file.
  std::string ErrorOf(const std::string& content) {
    const std::string message = MessageOf(ErrorKind::kBadInput, [&] { Read(content); });
    EXPECT_THAT(message, testing::HasSubstr(path_.string()));
    return message;
  }

  fs::path path_;
};

std::string Bytes(double value, bool swapped) {
  std::string bytes(sizeof(value), '\0');
  std::memcpy(bytes.data(), &value, sizeof(value));
  if (swapped) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

using testing::HasSubstr;

std::string PcdHeader(const std::string& data, int points) {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS rgb x y z\n"
         "SIZE 4 4 4 4\nTYPE U F F F\nCOUNT 1 1 1 1\nWIDTH " +
         std::to_string(points) + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " +
         std::to_string(points) + "\nDATA " + data + "\n";
}

std::string FloatBytes(std::initializer_list<float> values) {
  std::string bytes;
  for (const float value : values) {
    std::array<char, sizeof(value)> part;
    std::memcpy(part.data(), &value, sizeof(value));
    bytes.append(part.data(), part.size());
  }
  return bytes;
}

TEST_F(CloudFile, PcdAsciiWithoutUnmeasuredPoints) {
  const ObservedPoints points =
      Read(PcdHeader("ascii", 3) + "7 1 2 3\n7 nan nan nan\n7 0.5 -1 4\n");
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points.positions[1], Vec3(0.5, -1, 4));
}

TEST_F(CloudFile, PcdBinary) {
  const ObservedPoints points =
      Read(PcdHeader("binary", 2) + FloatBytes({0, 1, 2, 3}) + FloatBytes({0, 0.5f, -1, 4}));
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points.positions[0], Vec3(1, 2, 3));
  EXPECT_EQ(points.positions[1], Vec3(0.5, -1, 4));
}

// Eight floats, field by field: rgb is four bytes twice, compressed to a literal of one byte and a
// copy of seven; the others are literals.
TEST_F(CloudFile, PcdBinaryCompressed) {
  std::string packed{'\0', '\0', static_cast<char>(5 << 5), '\0'};
  packed += static_cast<char>(23);
  packed += FloatBytes({1, 0.5f, 2, -1, 3, 4});
  std::string sizes(8, '\0');
  sizes[0] = static_cast<char>(packed.size());
  sizes[4] = 32;
  const ObservedPoints points = Read(PcdHeader("binary_compressed", 2) + sizes + packed);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points.positions[0], Vec3(1, 2, 3));
  EXPECT_EQ(points.positions[1], Vec3(0.5, -1, 4));
  packed[2] = static_cast<char>(5 << 5 | 1);  // copies from before the beginning
  EXPECT_THAT(ErrorOf(PcdHeader("binary_compressed", 2) + sizes + packed), HasSubstr("damaged"));
}

TEST_F(CloudFile, PcdDefectsAreNamed) {
  EXPECT_THAT(ErrorOf(PcdHeader("ascii", 2) + "7 1 2 3\n"), HasSubstr("truncated: 1 of 2"));
  EXPECT_THAT(ErrorOf(PcdHeader("ascii", 1) + "7 1 2 x\n"), HasSubstr("'x' is not a number"));
  EXPECT_THAT(ErrorOf(PcdHeader("binary", 3) + FloatBytes({0, 1, 2, 3})),
              HasSubstr("truncated: 1 of 3"));
  EXPECT_THAT(ErrorOf(PcdHeader("zip", 1)), HasSubstr("'zip' is not known"));
  EXPECT_THAT(ErrorOf("# .PCD v0.7\nFIELDS x y\nSIZE 4 4\nTYPE F F\nPOINTS 1\nDATA ascii\n1 2\n"),
              HasSubstr("needs a field z"));
  EXPECT_THAT(ErrorOf("# .PCD v0.7\nFIELDS x y z\nPOINTS -1\nDATA ascii\n"), HasSubstr("'-1'"));
}

TEST_F(CloudFile, WrittenCloudReadsBackToTheSameBits) {
  ObservedPoints points;
  points.Add({0.1, -1e-300, 3}, {0, 0.6, 0.8}, 2.5f);
  points.Add({1.0 / 3, 1e9, -0.0}, Vec3::Zero(), 1);
  WriteCloud(path_, points);
  const ObservedPoints read = ReadCloud(path_);
  EXPECT_EQ(read.positions, points.positions);
  EXPECT_EQ(read.viewing_rays, points.viewing_rays);
  EXPECT_EQ(read.counts, points.counts);
}

TEST_F(CloudFile, EmptyCloudIsWrittenAndRead) {
  WriteCloud(path_, {});
  EXPECT_TRUE(ReadCloud(path_).empty());
}

TEST_F(CloudFile, ReadsXyzWithAndWithoutNormals) {
  const ObservedPoints points = Read("# scan 3\n1 2 3\n\n-1.5e-2\t2.5 3 0 0 1  # seen twice\r\n");
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points.positions[0], Vec3(1, 2, 3));
  EXPECT_EQ(points.positions[1], Vec3(-0.015, 2.5, 3));
  EXPECT_EQ(points.viewing_rays[1], Vec3::Zero());  // normals are not viewing rays
  EXPECT_EQ(points.counts[1], 1);
}

TEST_F(CloudFile, ReadsAsciiPlyInAnyOrderOfProperties) {
  const ObservedPoints points = Read(
      "ply\r\nformat ascii 1.0\r\ncomment by hand\r\nelement vertex 2\r\nproperty uchar red\r\n"
      "property float z\r\nproperty float y\r\nproperty double x\r\nproperty float count\r\n"
      "element face 1\r\nproperty list uchar int vertex_indices\r\nend_header\r\n"
      "255 3 2 1 4\r\n0 6 5 4 7\r\n3 0 1 0\r\n");
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points.positions[0], Vec3(1, 2, 3));
  EXPECT_EQ(points.positions[1], Vec3(4, 5, 6));
  EXPECT_EQ(points.counts, (std::vector<float>{4, 7}));
}

TEST_F(CloudFile, ReadsBinaryPlyOfEitherByteOrder) {
  for (const bool is_big : {false, true}) {
    const std::string header = std::string("ply\nformat binary_") + (is_big ? "big" : "little") +
                               "_endian 1.0\nelement vertex 1\nproperty int8 label\n"
                               "property double x\nproperty double y\nproperty double z\n"
                               "end_header\n";
    const ObservedPoints points =
        Read(header + "\x07" + Bytes(0.1, is_big) + Bytes(-2, is_big) + Bytes(3e5, is_big));
    ASSERT_EQ(points.size(), 1u);
    EXPECT_EQ(points.positions[0], Vec3(0.1, -2, 3e5));
  }
}

TEST_F(CloudFile, NamesLineAndValueOfBadXyz) {
  EXPECT_THAT(ErrorOf("1 2 3\n1 two 3\n"), HasSubstr("line 2: 'two' is not a number"));
  EXPECT_THAT(ErrorOf("1 2 3\n\n1 2\n"), HasSubstr("line 3: 2 columns"));
  EXPECT_THAT(ErrorOf("1 2 3 4\n"), HasSubstr("line 1: 4 columns"));
  EXPECT_THAT(ErrorOf("1 2 3\n1 nan 3\n"), HasSubstr("line 2: y is nan"));
  EXPECT_THAT(ErrorOf("1 2 1e999\n"), HasSubstr("line 1: '1e999' is not a number"));
  EXPECT_THAT(ErrorOf("# nothing\n"), HasSubstr("no point"));
  EXPECT_THAT(ErrorOf(""), HasSubstr("empty"));
}

TEST_F(CloudFile, NamesWhatIsWrongWithAPlyHeader) {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  EXPECT_THAT(ErrorOf("ply\nformat ascii 1.0\nelement vertex 1\n" + xyz), HasSubstr("end_header"));
  EXPECT_THAT(ErrorOf("ply\nformat text 1.0\nelement vertex 1\n" + xyz + "end_header\n0 0 0\n"),
              HasSubstr("'text'"));
  EXPECT_THAT(ErrorOf("ply\nformat ascii 1.0\nelement vertex -1\n" + xyz + "end_header\n"),
              HasSubstr("line 3: '-1'"));
  EXPECT_THAT(ErrorOf("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                      "property float y\nend_header\n0 0\n"),
              HasSubstr("0 properties 'z'"));
  EXPECT_THAT(ErrorOf("ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int i\n"
                      "element vertex 1\n" +
                      xyz + "end_header\n3 0 0 0\n0 0 0\n"),
              HasSubstr("line 3: element 'face' precedes"));
  EXPECT_THAT(ErrorOf("ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar int i\n" + xyz +
                      "end_header\n0 0 0 0\n"),
              HasSubstr("line 4: vertex property type 'list'"));
}

TEST_F(CloudFile, NamesLineOrVertexOfBadPlyValues) {
  const std::string ascii =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
      "property float z\nproperty float count\nend_header\n";
  EXPECT_THAT(ErrorOf(ascii + "0 0 0 1\n"), HasSubstr("truncated: 1 of 2 vertices"));
  EXPECT_THAT(ErrorOf(ascii + "0 0 0 1\n0 0 z 1\n"), HasSubstr("line 10: 'z'"));
  EXPECT_THAT(ErrorOf(ascii + "0 0 0 1\n0 0\n"), HasSubstr("line 10: ''"));
  EXPECT_THAT(ErrorOf(ascii + "0 0 0 1\n0 0 0 0\n"), HasSubstr("line 10: count is 0"));
  const std::string binary =
      "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty double x\n"
      "property double y\nproperty double z\nend_header\n";
  const std::string origin = Bytes(0, false) + Bytes(0, false) + Bytes(0, false);
  EXPECT_THAT(ErrorOf(binary + origin), HasSubstr("truncated: 1 of 2 vertices"));
  EXPECT_THAT(ErrorOf(binary + origin + Bytes(0, false) + Bytes(0, false) +
                      Bytes(std::numeric_limits<double>::infinity(), false)),
              HasSubstr("vertex 1: z is inf"));
}

TEST_F(CloudFile, HugeVertexCountIsTruncationNotExhaustion) {
  EXPECT_THAT(ErrorOf("ply\nformat binary_little_endian 1.0\nelement vertex 9223372036854775807\n"
                      "property double x\nproperty double y\nproperty double z\nend_header\n"),
              HasSubstr("truncated"));
}

TEST_F(CloudFile, MissingFileIsNamed) {
  EXPECT_THAT(MessageOf([&] { ReadCloud(path_); }), HasSubstr(path_.string()));
}

TEST(SharedCloudFiles, AreAllRead) {
  const fs::path folder = SharedData("clouds");
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there";
  EXPECT_EQ(ReadCloud(folder / "cageB.xyz").size(), 40000u);
  EXPECT_EQ(ReadCloud(folder / "bcpd_rope_00.ply").size(), 21586u);
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") continue;
    EXPECT_FALSE(ReadCloud(entry.path()).empty()) << entry.path();
  }
}

}  // namespace
}  // namespace curvefusion
