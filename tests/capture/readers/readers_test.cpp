#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "capture/check.h"
#include "capture/content/repair.h"
#include "capture/sequence.h"
#include "kernel/error.h"
#include "kernel/progress.h"
#include "tests/capture/content/room_scan.h"
#include "tests/capture/sequence_fixture.h"
#include "tests/error_message.h"
#include "tests/source_folder.h"

// No real recording of these layouts is part of the project: the samples are written here from the
// documents of each format, but for one model that COLMAP wrote.

namespace curvefusion {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

const RoomScan& Room() {
  static const RoomScan scan = MakeRoomScan();
  return scan;
}

RoomScan InMillimetres(RoomScan scan) {
  for (Image<uint16_t>& depth : scan.thumbnails.depth) {
    for (size_t i = 0; i < depth.size(); ++i) {
      depth.data()[i] = static_cast<uint16_t>(std::lround(depth.data()[i] / 5.0));
    }
  }
  return scan;
}

std::string OpenError(const fs::path& folder) {
  return MessageOf(ErrorKind::kBadInput, [&] { OpenSequence(folder); });
}

bool HasCause(const CheckReport& report, const std::string& cause) {
  for (const CheckFinding& finding : report.findings) {
    if (finding.cause == cause) return true;
  }
  return false;
}

// A folder with the images of the room: rgb/0.png ..., depth/0.png ... in 1/5000 m.
class ReadersTest : public testing::Test {
 protected:
  void SetUp() override { WriteImages(Room()); }

  void WriteImages(const RoomScan& scan) const {
    WriteRoomScan(scan, folder());
    for (const char* name :
         {"rgb.txt", "depth.txt", "associations.txt", "trajectory.txt", "intrinsics.json"}) {
      fs::remove(folder() / name);
    }
  }

  fs::path folder() const { return folder_.path(); }

  // Poses as they were, up to a motion of the world and the last digits.
  static void ExpectPoses(const Sequence& sequence, double tolerance) {
    ASSERT_EQ(sequence.frame_count(), kRoomFrames);
    for (int i = 0; i < kRoomFrames; ++i) {
      const auto k = static_cast<size_t>(i);
      const RigidTransform& expected = Room().sequence.frames[k].T_world_camera;
      EXPECT_LT((sequence.frames[k].T_world_camera.matrix() - expected.matrix()).norm(), tolerance)
          << i;
      EXPECT_EQ(sequence.frames[k].depth_path.filename(), fmt::format("{}.png", i));
    }
  }

  void ExpectGeometryFits() const {
    const CheckReport report = CheckSequence(folder(), NoProgress);
    EXPECT_TRUE(report.geometry.is_judged);
    EXPECT_TRUE(report.geometry.fits);
  }

 private:
  TemporaryFolder folder_;
};

class Nerfstudio : public ReadersTest {
 protected:
  void SetUp() override {
    ReadersTest::SetUp();
    const PinholeCamera& camera = Room().sequence.color_camera;
    transforms = {{"camera_model", "OPENCV"},
                  {"w", camera.width},
                  {"h", camera.height},
                  {"fl_x", camera.fx},
                  {"fl_y", camera.fy},
                  {"cx", camera.cx + 0.5},
                  {"cy", camera.cy + 0.5},
                  {"k1", 0},
                  {"k2", 0},
                  {"p1", 0},
                  {"p2", 0},
                  {"depth_unit_scale_factor", 1 / 5000.0},
                  {"frames", json::array()}};
    for (int i = kRoomFrames - 1; i >= 0; --i) {  // in no order
      Eigen::Matrix4d matrix =
          Room().sequence.frames[static_cast<size_t>(i)].T_world_camera.matrix();
      matrix.col(1) *= -1;
      matrix.col(2) *= -1;
      json rows = json::array();
      for (int row = 0; row < 4; ++row) {
        rows.push_back({matrix(row, 0), matrix(row, 1), matrix(row, 2), matrix(row, 3)});
      }
      transforms["frames"].push_back({{"file_path", fmt::format("./rgb/{}.png", i)},
                                      {"depth_file_path", fmt::format("depth/{}.png", i)},
                                      {"transform_matrix", rows}});
    }
  }

  void Write() const { WriteText(folder() / "transforms.json", transforms.dump()); }
  std::string ErrorOfFile() const {
    Write();
    return OpenError(folder());
  }

  json transforms;
};

TEST_F(Nerfstudio, HasOpenGlAxesAndPixelCorners) {
  Write();
  const Sequence sequence = OpenSequence(folder());
  EXPECT_EQ(sequence.format, "nerfstudio");
  EXPECT_NEAR(sequence.depth_scale, 5000, 1e-9);
  EXPECT_EQ(sequence.color_camera.cx, Room().sequence.color_camera.cx);
  EXPECT_EQ(sequence.frames[10].name, "10");
  EXPECT_EQ(sequence.frames[10].timestamp, 10);
  ExpectPoses(sequence, 1e-12);
  ExpectGeometryFits();
}

TEST_F(Nerfstudio, MayHaveColourAndPosesOnly) {
  for (json& frame : transforms["frames"]) frame.erase("depth_file_path");
  fs::remove_all(folder() / "depth");
  Write();
  const Sequence sequence = OpenSequence(folder(), PoseUse::kNeeded, DepthUse::kIfGiven);
  EXPECT_FALSE(sequence.has_depth);
  EXPECT_EQ(sequence.frame_count(), kRoomFrames);
  EXPECT_EQ(sequence.depth_camera.width, sequence.color_camera.width);
  EXPECT_THAT(OpenError(folder()), HasSubstr("no depth images"));
}

TEST_F(Nerfstudio, DepthIsInMillimetresUnlessToldOtherwise) {
  transforms.erase("depth_unit_scale_factor");
  Write();
  EXPECT_EQ(OpenSequence(folder()).depth_scale, 1000);
}

TEST_F(Nerfstudio, InstantNgpGivesTheAngleAndNamesWithoutExtension) {
  const double width = transforms["w"];
  const double f = transforms["fl_x"];
  transforms.erase("fl_x");
  transforms.erase("fl_y");
  transforms["camera_angle_x"] = 2 * std::atan(width / 2 / f);
  transforms["integer_depth_scale"] = transforms["depth_unit_scale_factor"];
  transforms.erase("depth_unit_scale_factor");
  for (json& frame : transforms["frames"]) {
    const std::string name = frame["file_path"];
    frame["file_path"] = name.substr(0, name.size() - 4);
    frame["depth_path"] = frame["depth_file_path"];
    frame.erase("depth_file_path");
  }
  Write();
  const Sequence sequence = OpenSequence(folder());
  EXPECT_NEAR(sequence.color_camera.fx, f, 1e-9);
  EXPECT_NEAR(sequence.color_camera.fy, f, 1e-9);
  ExpectPoses(sequence, 1e-12);
}

TEST_F(Nerfstudio, OneCameraMayStandInEveryFrameButNotSeveral) {
  for (json& frame : transforms["frames"]) frame["fl_x"] = transforms["fl_x"];
  transforms.erase("fl_x");
  Write();
  EXPECT_EQ(OpenSequence(folder()).color_camera.fx, Room().sequence.color_camera.fx);
  transforms["frames"][7]["fl_x"] = 76.5;
  EXPECT_THAT(ErrorOfFile(), AllOf(HasSubstr("transforms.json: frame 7"), HasSubstr("76.5"),
                                   HasSubstr("one camera for all frames")));
}

TEST_F(Nerfstudio, DepthMayBeSmaller) {
  transforms["w"] = 160;
  transforms["h"] = 120;
  for (const char* key : {"fl_x", "fl_y", "cx", "cy"}) {
    transforms[key] = 2 * transforms[key].get<double>();
  }
  for (int i = 0; i < kRoomFrames; ++i) {
    WriteColor(folder() / fmt::format("rgb/{}.png", i), 160, 120);
  }
  Write();
  const Sequence sequence = OpenSequence(folder());
  EXPECT_EQ(sequence.color_camera.width, 160);
  EXPECT_EQ(sequence.depth_camera.width, 80);
  EXPECT_NEAR(sequence.depth_camera.fx, Room().sequence.depth_camera.fx, 1e-9);
  EXPECT_NEAR(sequence.depth_camera.cx, Room().sequence.depth_camera.cx, 1e-9);
  transforms["h"] = 100;
  EXPECT_THAT(ErrorOfFile(), AllOf(HasSubstr("depth/"), HasSubstr("80x60"), HasSubstr("160x100")));
}

TEST_F(Nerfstudio, NamesWhatIsWrong) {
  const json whole = transforms;
  const auto error_with = [&](const auto& change) {
    transforms = whole;
    change(transforms);
    return ErrorOfFile();
  };
  EXPECT_THAT(error_with([](json& t) { t["frames"][3].erase("depth_file_path"); }),
              AllOf(HasSubstr("frame 3"), HasSubstr("'depth_file_path' is missing")));
  EXPECT_THAT(error_with([](json& t) { t["frames"][3]["depth_file_path"] = "depth/3.npy"; }),
              HasSubstr("16-bit grey PNG"));
  EXPECT_THAT(error_with([](json& t) { t["frames"][4].erase("transform_matrix"); }),
              AllOf(HasSubstr("frame 4"), HasSubstr("'transform_matrix'")));
  EXPECT_THAT(error_with([](json& t) { t["frames"][4]["transform_matrix"][0][0] = 7; }),
              AllOf(HasSubstr("frame 4"), HasSubstr("transform_matrix")));
  EXPECT_THAT(error_with([](json& t) { t["camera_model"] = "OPENCV_FISHEYE"; }),
              HasSubstr("OPENCV_FISHEYE"));
  EXPECT_THAT(error_with([](json& t) { t["k4"] = .1; }), HasSubstr("'k4'"));
  EXPECT_THAT(error_with([](json& t) { t["is_fisheye"] = true; }), HasSubstr("undistort"));
  EXPECT_THAT(error_with([](json& t) { t["w"] = 1e9; }), HasSubstr("'w' is"));
  EXPECT_THAT(error_with([](json& t) { t["depth_unit_scale_factor"] = 0; }),
              HasSubstr("'depth_unit_scale_factor' is 0"));
  EXPECT_THAT(error_with([](json& t) { t["frames"] = json::array(); }), HasSubstr("'frames'"));
}

TEST_F(Nerfstudio, IsTrackedOnDemandAndBeatenByPosesOfItsOwnFolder) {
  Write();
  const Sequence sequence = OpenSequence(folder(), PoseUse::kIgnored);
  EXPECT_FALSE(sequence.has_poses);
  EXPECT_EQ(sequence.frame_count(), kRoomFrames);
  // Without poses of its own, a layout with cameras does not hide these.
  WriteText(folder() / "intrinsics.json",
            R"({"width":80,"height":60,"fx":75,"fy":75,"cx":39.5,"cy":29.5})");
  EXPECT_EQ(OpenSequence(folder(), PoseUse::kIfGiven).format, "nerfstudio");
}

template <class T>
void Put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

class Colmap : public ReadersTest {
 protected:
  void SetUp() override {
    ReadersTest::SetUp();
    WriteImages(InMillimetres(Room()));
    fs::rename(folder() / "rgb", folder() / "images");
  }

  // World to camera, as COLMAP has it.
  RigidTransform PoseOf(int frame) const {
    RigidTransform T_world_camera =
        Room().sequence.frames[static_cast<size_t>(frame)].T_world_camera;
    T_world_camera.translation() *= scale;
    return T_world_camera.inverse();
  }

  void WriteTextModel(const fs::path& model, const std::string& camera) const {
    std::string images = "# Image list with two lines of data per image:\n";
    for (int i = 0; i < kRoomFrames; ++i) {
      const RigidTransform T = PoseOf(i);
      const Eigen::Quaterniond q(T.linear());
      images += fmt::format("{} {} {} {} {} {} {} {} 3 {}.png\n", i + 1, q.w(), q.x(), q.y(), q.z(),
                            T.translation().x(), T.translation().y(), T.translation().z(), i);
      // The line of points may be empty, or longer than any buffer.
      std::string points;
      while (i == 5 && points.size() < 100000) points += "12.5 13.5 -1 ";
      images += points + "\n";
    }
    WriteText(model / "cameras.txt", "# Camera list\n3 " + camera + "\n");
    WriteText(model / "images.txt", images);
  }

  void WriteBinaryModel(const fs::path& model) const {
    std::string cameras;
    Put<uint64_t>(cameras, 1);
    Put<uint32_t>(cameras, 3);
    Put<uint32_t>(cameras, 1);  // PINHOLE
    Put<uint64_t>(cameras, 80);
    Put<uint64_t>(cameras, 60);
    for (const double value : {75.0, 75.0, 40.0, 30.0}) Put(cameras, value);
    std::string images;
    Put<uint64_t>(images, kRoomFrames);
    for (int i = 0; i < kRoomFrames; ++i) {
      const RigidTransform T = PoseOf(i);
      const Eigen::Quaterniond q(T.linear());
      Put<uint32_t>(images, static_cast<uint32_t>(i + 1));
      for (const double value : {q.w(), q.x(), q.y(), q.z()}) Put(images, value);
      for (const double value : T.translation()) Put(images, value);
      Put<uint32_t>(images, 3);
      images += fmt::format("{}.png", i);
      images += '\0';
      Put<uint64_t>(images, 2);
      images.append(48, 'x');
    }
    WriteText(model / "cameras.bin", cameras);
    WriteText(model / "images.bin", images);
  }

  double scale = 1;
};

TEST_F(Colmap, TextAndBinaryModelsAreTheSame) {
  for (const char* place : {"sparse/0", "sparse", "."}) {
    WriteTextModel(folder() / place, "PINHOLE 80 60 75 75 40 30");
    const Sequence text = OpenSequence(folder());
    EXPECT_EQ(text.format, "colmap");
    EXPECT_EQ(text.depth_scale, 1000);
    EXPECT_EQ(text.color_camera.cx, 39.5);
    ExpectPoses(text, 1e-9);
    ASSERT_EQ(text.warnings.size(), 1u);
    EXPECT_THAT(text.warnings[0], HasSubstr("scale"));
    fs::remove(folder() / place / "cameras.txt");
    fs::remove(folder() / place / "images.txt");
    WriteBinaryModel(folder() / place);
    ExpectPoses(OpenSequence(folder()), 1e-12);
    fs::remove(folder() / place / "cameras.bin");
    fs::remove(folder() / place / "images.bin");
  }
}

// The model in colmap_model was written by COLMAP 3.8 itself (Debian 12): `colmap model_converter`
// made the .bin files of a text model, and the .txt files of these.
TEST_F(Colmap, ReadsWhatColmapItselfWrites) {
  // World to camera: a quarter of a turn about y and (.1, .2, .3); (-1, 0, 0); half a turn about z
  // and (.5, .25, 0).
  const std::array<Vec3, 3> centers = {Vec3(0.3, -0.2, -0.1), Vec3(1, 0, 0), Vec3(0.5, 0.25, 0)};
  fs::create_directories(folder() / "sparse/0");
  for (const char* extension : {".txt", ".bin"}) {  // where both are there, .bin is read
    for (const char* stem : {"cameras", "images"}) {
      const std::string name = std::string(stem) + extension;
      fs::copy_file(SourceFolder() / "tests/capture/readers/colmap_model" / name,
                    folder() / "sparse/0" / name);
    }
    const Sequence sequence = OpenSequence(folder());
    EXPECT_EQ(sequence.format, "colmap");
    EXPECT_EQ(sequence.color_camera.fx, 75);
    EXPECT_EQ(sequence.color_camera.cx, 39.5);
    ASSERT_EQ(sequence.frame_count(), 3);
    for (size_t i = 0; i < centers.size(); ++i) {
      const RigidTransform& T_world_camera = sequence.frames[i].T_world_camera;
      EXPECT_LT((T_world_camera.translation() - centers[i]).norm(), 1e-12) << extension << i;
    }
    const Vec3 looks = sequence.frames[0].T_world_camera.linear() * Vec3::UnitZ();
    EXPECT_LT((looks - Vec3(-1, 0, 0)).norm(), 1e-12);
  }
}

TEST_F(Colmap, MayHaveColourAndPosesOnly) {
  WriteBinaryModel(folder() / "sparse/0");
  fs::remove_all(folder() / "depth");
  const Sequence sequence = OpenSequence(folder(), PoseUse::kNeeded, DepthUse::kIfGiven);
  EXPECT_FALSE(sequence.has_depth);
  EXPECT_EQ(sequence.frame_count(), kRoomFrames);
  ASSERT_EQ(sequence.warnings.size(), 1u);
  EXPECT_THAT(sequence.warnings[0], HasSubstr("poses, which must be in metres"));
}

TEST_F(Colmap, DepthTellsTheScale) {
  WriteBinaryModel(folder() / "sparse/0");
  ExpectGeometryFits();
  scale = 3.7;
  WriteBinaryModel(folder() / "sparse/0");
  const CheckReport report = CheckSequence(folder(), NoProgress);
  EXPECT_TRUE(HasCause(report, "translation-scale"));
  ASSERT_TRUE(report.geometry.correction);
  const fs::path repaired = folder() / "repaired";
  WriteRepairedSequence(*report.geometry.correction, repaired);
  const CheckReport after = CheckSequence(repaired, NoProgress);
  EXPECT_TRUE(after.geometry.fits);
  EXPECT_FALSE(HasCause(after, "colmap-scale"));
  const Sequence metric = OpenSequence(repaired);
  const Vec3 step = metric.frames[40].T_world_camera.translation() -
                    metric.frames[0].T_world_camera.translation();
  const Vec3 expected = Room().sequence.frames[40].T_world_camera.translation() -
                        Room().sequence.frames[0].T_world_camera.translation();
  // The check finds the scale to a percent from 80x60 pixels.
  EXPECT_NEAR(step.norm(), expected.norm(), 0.01 * expected.norm());
}

TEST_F(Colmap, ReadsTheModelsOfBrownConrady) {
  const auto open = [&](const std::string& camera) {
    WriteTextModel(folder(), camera);
    return OpenSequence(folder());
  };
  EXPECT_EQ(open("SIMPLE_PINHOLE 80 60 75 40 30").color_camera.fy, 75);
  EXPECT_EQ(open("SIMPLE_RADIAL 80 60 75 40 30 -0.01").color_distortion.k1, -0.01);
  EXPECT_EQ(open("RADIAL 80 60 75 40 30 -0.01 0.002").color_distortion.k2, 0.002);
  const Sequence opencv = open("OPENCV 80 60 75 76 40 30 -0.01 0.002 0.0003 -0.0004");
  EXPECT_EQ(opencv.color_camera.fx, 75);
  EXPECT_EQ(opencv.color_camera.fy, 76);
  EXPECT_EQ(opencv.color_distortion.p1, 0.0003);
  EXPECT_EQ(opencv.color_distortion.p2, -0.0004);
  EXPECT_EQ(opencv.depth_distortion.p2, -0.0004);
}

TEST_F(Colmap, NamesWhatIsWrong) {
  const auto error_of = [&](const std::string& camera) {
    WriteTextModel(folder(), camera);
    return OpenError(folder());
  };
  EXPECT_THAT(error_of("OPENCV_FISHEYE 80 60 75 75 40 30 0 0 0 0"),
              AllOf(HasSubstr("OPENCV_FISHEYE"), HasSubstr("colmap image_undistorter")));
  EXPECT_THAT(error_of("MAGIC 80 60 75"), HasSubstr("MAGIC"));
  EXPECT_THAT(error_of("PINHOLE 80 60 75 75 40"), HasSubstr("cameras.txt:2"));
  EXPECT_THAT(error_of("PINHOLE 80 -60 75 75 40 30"), HasSubstr("image side"));
  EXPECT_THAT(error_of("PINHOLE 80 60 nan 75 40 30"), HasSubstr("not finite"));
  WriteTextModel(folder(), "PINHOLE 80 60 75 75 40 30");
  std::ofstream(folder() / "images.txt", std::ios::app) << "99 1 0 0 0 0 0 0 8 1.png\n\n";
  EXPECT_THAT(OpenError(folder()), AllOf(HasSubstr("camera 8"), HasSubstr("not there")));
  WriteTextModel(folder(), "PINHOLE 80 60 75 75 40 30");
  fs::remove_all(folder() / "depth");
  EXPECT_THAT(OpenError(folder()), AllOf(HasSubstr("depth"), HasSubstr("16-bit")));
}

TEST_F(Colmap, ATruncatedModelIsRefused) {
  const fs::path model = folder() / "sparse/0";
  WriteBinaryModel(model);
  for (const char* file : {"cameras.bin", "images.bin"}) {
    WriteBinaryModel(model);
    Truncate(model / file, 0.7);
    EXPECT_THAT(OpenError(folder()), AllOf(HasSubstr(file), HasSubstr("ends too early")));
  }
  WriteBinaryModel(model);
  std::string images(8, '\0');
  images[0] = 1;
  images.resize(8 + 4 + 7 * 8 + 4, '\0');
  images += std::string("0.png\0", 6) + std::string(8, '\xff');  // 2^64 - 1 points
  WriteText(model / "images.bin", images);
  EXPECT_THAT(OpenError(folder()), HasSubstr("ends too early"));
}

TEST_F(Colmap, ImagesWithoutDepthAreCounted) {
  WriteBinaryModel(folder());
  fs::remove(folder() / "depth/4.png");
  const Sequence sequence = OpenSequence(folder());
  EXPECT_EQ(sequence.frame_count(), kRoomFrames - 1);
  EXPECT_EQ(sequence.frames_without_partner, 1);
}

// The world of ICL-NUIM is the mirror image of ours: y is up in world and camera.
TEST_F(ReadersTest, IclNuimIsMirrored) {
  std::string pairs;
  std::string poses;
  const Eigen::DiagonalMatrix<double, 3> flip(1, -1, 1);
  for (int i = 0; i < kRoomFrames; ++i) {
    const RigidTransform& pose = Room().sequence.frames[static_cast<size_t>(i)].T_world_camera;
    const Eigen::Quaterniond q(Eigen::Matrix3d(flip * pose.linear() * flip));
    const Vec3 t = flip * pose.translation();
    pairs += fmt::format("{0} depth/{0}.png {0} rgb/{0}.png\n", i);
    if (i == 0) continue;  // as in the data set, poses begin at 1
    poses += fmt::format("{} {} {} {} {} {} {} {}\n", i, t.x(), t.y(), t.z(), q.x(), q.y(), q.z(),
                         q.w());
  }
  WriteText(folder() / "associations.txt", pairs);
  WriteText(folder() / "livingRoom1.gt.freiburg", poses);
  EXPECT_THAT(OpenError(folder()), HasSubstr("640x480"));  // the data set's camera
  WriteText(folder() / "intrinsics.json",
            R"({"width":80,"height":60,"fx":75,"fy":75,"cx":39.5,"cy":29.5})");
  const Sequence sequence = OpenSequence(folder());
  EXPECT_EQ(sequence.format, "icl-nuim");
  EXPECT_EQ(sequence.depth_scale, 5000);
  ASSERT_EQ(sequence.frame_count(), kRoomFrames - 1);
  EXPECT_EQ(sequence.frames_without_pose, 1);
  EXPECT_DOUBLE_EQ(sequence.frames[29].timestamp, 1);
  EXPECT_LT((sequence.frames[29].T_world_camera.matrix() -
             Room().sequence.frames[30].T_world_camera.matrix())
                .norm(),
            1e-9);
  ExpectGeometryFits();
}

class StrayScanner : public ReadersTest {
 protected:
  void SetUp() override {
    WriteImages(InMillimetres(Room()));
    std::string odometry = "timestamp, frame, x, y, z, qx, qy, qz, qw\n";
    for (int i = 0; i < kRoomFrames; ++i) {
      const SequenceFrame& frame = Room().sequence.frames[static_cast<size_t>(i)];
      const Eigen::Quaterniond q(frame.T_world_camera.linear());
      const Vec3 t = frame.T_world_camera.translation();
      odometry += fmt::format("{}, {:06}, {}, {}, {}, {}, {}, {}, {}\n", frame.timestamp, i, t.x(),
                              t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
    }
    WriteText(folder() / "odometry.csv", odometry);
    WriteText(folder() / "camera_matrix.csv",
              "150.0, 0.0, 79.5\n0.0, 150.0, 59.5\n0.0, 0.0, 1.0\n");
    for (int i = 0; i < kRoomFrames; ++i) {  // colour of twice the size
      const fs::path path = folder() / fmt::format("rgb/{}.png", i);
      fs::remove(path);
      WriteColor(path, 160, 120);
    }
  }
};

TEST_F(StrayScanner, HasSmallDepthAndPosesOfOurAxes) {
  const Sequence sequence = OpenSequence(folder());
  EXPECT_EQ(sequence.format, "stray scanner");
  EXPECT_EQ(sequence.depth_scale, 1000);
  EXPECT_EQ(sequence.color_camera.width, 160);
  EXPECT_EQ(sequence.color_camera.fx, 150);
  EXPECT_EQ(sequence.depth_camera.width, 80);
  EXPECT_EQ(sequence.depth_camera.fx, 75);
  EXPECT_EQ(sequence.depth_camera.cx, 39.5);
  EXPECT_NEAR(sequence.frames[30].timestamp, 101, 1e-6);
  ExpectPoses(sequence, 1e-12);
  ExpectGeometryFits();
}

TEST_F(StrayScanner, TellsHowToUnpackTheVideo) {
  fs::remove_all(folder() / "rgb");
  WriteText(folder() / "rgb.mp4", "video");
  EXPECT_THAT(OpenError(folder()), AllOf(HasSubstr("rgb.mp4"), HasSubstr("curvefusion unpack '")));
}

TEST_F(StrayScanner, NamesWhatIsWrong) {
  std::ofstream(folder() / "odometry.csv", std::ios::app) << "7, 60, 0, 0, nought\n";
  EXPECT_THAT(OpenError(folder()), AllOf(HasSubstr("odometry.csv:62"), HasSubstr("column 5")));
  WriteText(folder() / "odometry.csv", "timestamp, frame, x\n1, 0, 0, 0, 0, 0, 0, 0, 1\n");
  EXPECT_EQ(OpenSequence(folder()).frames_without_pose, kRoomFrames - 1);
  WriteText(folder() / "odometry.csv", "1, 0, 0, 0, 0, 0, 0, 0, 7\n");
  EXPECT_THAT(OpenError(folder()), AllOf(HasSubstr("odometry.csv:1"), HasSubstr("length 7")));
  WriteText(folder() / "camera_matrix.csv", "150, 0, 79.5\n");
  EXPECT_THAT(OpenError(folder()), HasSubstr("3x3"));
}

TEST(Containers, AreNamedWithTheWayToExportThem) {
  TemporaryFolder folder;
  WriteText(folder.path() / "scan.r3d", "content");
  const auto names_it = AllOf(HasSubstr("scan.r3d"), HasSubstr("transforms.json"));
  EXPECT_THAT(OpenError(folder.path() / "scan.r3d"), names_it);
  const CheckReport report = CheckSequence(folder.path(), NoProgress);  // also in a folder
  ASSERT_EQ(report.findings.size(), 1u);
  EXPECT_THAT(report.findings[0].message, names_it);
}

}  // namespace
}  // namespace curvefusion
