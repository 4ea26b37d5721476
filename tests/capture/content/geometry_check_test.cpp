#include "capture/content/geometry_check.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "capture/check.h"
#include "capture/content/repair.h"
#include "kernel/error.h"
#include "tests/capture/content/room_scan.h"
#include "tests/capture/sequence_fixture.h"

namespace curvefusion {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// Rendered once: every test spoils a copy.
const RoomScan& Room() {
  static const RoomScan room = MakeRoomScan();
  return room;
}

struct Checked {
  GeometryReport report;
  std::vector<std::string> causes;
  std::vector<CheckFinding> findings;
};

Checked Check(const RoomScan& scan) {
  Checked checked;
  checked.report =
      CheckGeometry(scan.sequence, scan.thumbnails, [&checked](const CheckFinding& finding) {
        checked.causes.push_back(finding.cause);
        checked.findings.push_back(finding);
      });
  return checked;
}

// One finding of this cause, and a correction whose poses move as the right ones do.
void ExpectNamedAndCorrected(const RoomScan& wrong, const std::string& cause,
                             const std::string& words = "--repair DIR") {
  const Checked checked = Check(wrong);
  EXPECT_THAT(checked.causes, ElementsAre(cause));
  ASSERT_TRUE(checked.report.correction);
  EXPECT_THAT(checked.findings[0].message, HasSubstr(words));
  const Sequence& corrected = checked.report.correction->sequence;
  const SequenceFrame& first = corrected.frames.front();
  const SequenceFrame& last = corrected.frames.back();
  const auto right = [](const SequenceFrame& frame) {
    return Room().sequence.frames[std::stoul(frame.name)].T_world_camera;
  };
  const RigidTransform motion = first.T_world_camera.inverse() * last.T_world_camera;
  const RigidTransform right_motion = right(first).inverse() * right(last);
  // A scale is known to some percent only where it is no customary unit.
  EXPECT_LT((motion.matrix() - right_motion.matrix()).norm(), 0.02);
}

template <class Change>
RoomScan WithPoses(const Change& change) {
  RoomScan scan = Room();
  for (SequenceFrame& frame : scan.sequence.frames) {
    frame.T_world_camera = change(frame.T_world_camera);
  }
  return scan;
}

RoomScan WithScaledTranslations(double factor) {
  return WithPoses([factor](RigidTransform pose) {
    pose.translation() *= factor;
    return pose;
  });
}

// Frame i with the pose of frame order(i); those that have none keep theirs.
template <class Order>
RoomScan WithPoseOf(const Order& order) {
  RoomScan scan = Room();
  for (int i = 0; i < kRoomFrames; ++i) {
    const int other = order(i);
    if (other < 0 || other >= kRoomFrames) continue;
    scan.sequence.frames[static_cast<size_t>(i)].T_world_camera =
        Room().sequence.frames[static_cast<size_t>(other)].T_world_camera;
  }
  return scan;
}

TEST(GeometryCheck, AGoodScanFitsAndHasFigures) {
  const Checked checked = Check(Room());
  EXPECT_THAT(checked.findings, IsEmpty());
  EXPECT_TRUE(checked.report.is_judged);
  EXPECT_TRUE(checked.report.fits);
  EXPECT_FALSE(checked.report.correction);
  ASSERT_THAT(checked.report.by_gap, SizeIs(4));
  EXPECT_EQ(checked.report.by_gap[3].gap, 30);
  EXPECT_GT(checked.report.by_gap[0].overlap, 0.7);  // measured: .9; the rest lies on edges
  for (const DepthDisagreement& part : checked.report.by_gap) {
    EXPECT_LT(part.residual, 0.001) << part.gap;  // planes, rounded to .2 mm
    EXPECT_GT(part.points, 0);
  }
  EXPECT_FALSE(checked.report.by_distance.empty());
}

TEST(GeometryCheck, InvertedPoses) {
  const RoomScan wrong = WithPoses([](const RigidTransform& pose) { return pose.inverse(); });
  ExpectNamedAndCorrected(wrong, "poses-inverted", "mm as given");
}

TEST(GeometryCheck, QuaternionWithWFirst) {
  ExpectNamedAndCorrected(WithPoses([](RigidTransform pose) {
                            const Eigen::Quaterniond q(pose.linear());
                            pose.linear() =
                                Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()).toRotationMatrix();
                            return pose;
                          }),
                          "quaternion-w-first");
}

TEST(GeometryCheck, OpenGlAxes) {
  ExpectNamedAndCorrected(WithPoses([](RigidTransform pose) {
                            pose.linear() = pose.linear() * Vec3(1, -1, -1).asDiagonal();
                            return pose;
                          }),
                          "opengl-axes");
}

TEST(GeometryCheck, TranslationsInOtherUnits) {
  for (const double factor : {1000.0, 0.37}) {
    ExpectNamedAndCorrected(WithScaledTranslations(factor), "translation-scale",
                            factor == 1000 ? "in millimetres, not metres" : "multiplied by 2.7");
  }
}

TEST(GeometryCheck, DepthUnits) {
  for (const double factor : {2.0, 0.2, 1000.0}) {
    RoomScan wrong = Room();
    wrong.sequence.depth_scale *= factor;
    const Checked checked = Check(wrong);
    ASSERT_THAT(checked.causes, ElementsAre("depth-scale")) << factor;
    EXPECT_THAT(checked.findings[0].message, HasSubstr("\"depth_scale\": 5000"));
    EXPECT_EQ(checked.report.correction->sequence.depth_scale, 5000);
  }
}

TEST(GeometryCheck, SwappedBytes) {
  RoomScan wrong = Room();
  for (Image<uint16_t>& depth : wrong.thumbnails.depth) {
    for (size_t i = 0; i < depth.size(); ++i) {
      depth.data()[i] = static_cast<uint16_t>((depth.data()[i] << 8) | (depth.data()[i] >> 8));
    }
  }
  const Checked checked = Check(wrong);
  EXPECT_THAT(checked.causes, ElementsAre("depth-bytes-swapped"));
  EXPECT_TRUE(checked.report.correction->swap_bytes);
}

TEST(GeometryCheck, LatePoses) {
  for (const int delay : {1, -10}) {
    const RoomScan wrong = WithPoseOf([delay](int i) { return i - delay; });
    ExpectNamedAndCorrected(
        wrong, "poses-late",
        fmt::format("{} by {} frame", delay > 0 ? "late" : "early", std::abs(delay)));
  }
}

TEST(GeometryCheck, PosesInAnotherOrder) {
  ExpectNamedAndCorrected(WithPoseOf([](int i) { return kRoomFrames - 1 - i; }), "frame-order");
  std::vector<int> text_order(kRoomFrames);
  for (int i = 0; i < kRoomFrames; ++i) text_order[static_cast<size_t>(i)] = i;
  std::sort(text_order.begin(), text_order.end(),
            [](int a, int b) { return std::to_string(a) < std::to_string(b); });
  ExpectNamedAndCorrected(WithPoseOf([&](int i) { return text_order[static_cast<size_t>(i)]; }),
                          "frame-order");
}

TEST(GeometryCheck, LateColor) {
  for (const int delay : {2, -5}) {
    RoomScan wrong = Room();
    for (int i = 0; i < kRoomFrames; ++i) {
      const int other = std::clamp(i - delay, 0, kRoomFrames - 1);
      wrong.thumbnails.grey[static_cast<size_t>(i)] =
          Room().thumbnails.grey[static_cast<size_t>(other)];
    }
    const Checked checked = Check(wrong);
    ASSERT_THAT(checked.causes, ElementsAre("colour-late")) << delay;
    EXPECT_THAT(
        checked.findings[0].message,
        HasSubstr(fmt::format("are {} frames {}", std::abs(delay), delay > 0 ? "late" : "early")));
  }
}

RigidTransform MovedAside(RigidTransform pose) {
  pose.translation() += Vec3(0.03, 0.02, -0.02);
  pose.rotate(Eigen::AngleAxisd(0.03, Vec3::UnitY()));
  return pose;
}

TEST(GeometryCheck, OnePoseThatIsOffIsLeftOut) {
  RoomScan wrong = Room();
  wrong.sequence.frames[23].T_world_camera = MovedAside(wrong.sequence.frames[23].T_world_camera);
  const Checked checked = Check(wrong);
  ASSERT_THAT(checked.causes, ElementsAre("pose-jump"));
  EXPECT_THAT(checked.findings[0].message, HasSubstr("frames are off: 000023;"));
  ASSERT_TRUE(checked.report.correction);
  EXPECT_EQ(checked.report.correction->sequence.frame_count(), kRoomFrames - 1);
}

TEST(GeometryCheck, AJumpIsNamedByItsFrame) {
  RoomScan wrong = Room();
  for (size_t i = 41; i < kRoomFrames; ++i) {
    wrong.sequence.frames[i].T_world_camera = MovedAside(wrong.sequence.frames[i].T_world_camera);
  }
  const Checked checked = Check(wrong);
  ASSERT_THAT(checked.causes, ElementsAre("pose-jump"));
  EXPECT_THAT(checked.findings[0].message, HasSubstr("from frame 000040 to 000041"));
  EXPECT_EQ(checked.findings[0].severity, Severity::kError);
}

TEST(GeometryCheck, ABadStretchIsListed) {
  RoomScan wrong = Room();
  for (size_t i = 20; i < 35; ++i) {  // turns away by up to 18 degrees and back: no jump
    wrong.sequence.frames[i].T_world_camera.rotate(
        Eigen::AngleAxisd(0.04 * std::min<double>(i - 19, 35 - i), Vec3::UnitX()));
  }
  const Checked checked = Check(wrong);
  ASSERT_THAT(checked.causes, ElementsAre("bad-stretch"));
  ASSERT_THAT(checked.report.mistakes, SizeIs(1));
  const FrameStretch stretch = checked.report.mistakes[0].frames.at(0);
  // At the stretch's ends, 7 degrees about x are 2.4 % of the distance in the median: no bad
  // frames.
  EXPECT_NEAR(std::stoi(stretch.first), 20, 3);
  EXPECT_NEAR(std::stoi(stretch.last), 34, 3);
}

TEST(GeometryCheck, PosesOfAnotherScanAreNotExplained) {
  RoomScan wrong = Room();
  for (int i = 0; i < kRoomFrames; ++i) {  // another hand's motion
    wrong.sequence.frames[static_cast<size_t>(i)].T_world_camera =
        RigidTransform(Eigen::Translation3d(0.2 * std::sin(0.11 * i), 0.003 * i, 0) *
                       Eigen::AngleAxisd(0.4 * std::cos(0.13 * i), Vec3::UnitY()));
  }
  const Checked checked = Check(wrong);
  EXPECT_THAT(checked.causes, ElementsAre("poses-do-not-fit"));
  EXPECT_FALSE(checked.report.correction);
}

TEST(GeometryCheck, WhatCannotBeJudgedIsNoComplaint) {
  for (const RoomScan& scan : {MakeRoomScan(0), MakeWallScan()}) {
    const Checked checked = Check(scan);
    EXPECT_THAT(checked.findings, IsEmpty());
    EXPECT_FALSE(checked.report.is_judged);
    EXPECT_THAT(checked.report.why_not, HasSubstr("hardly differ"));
  }
}

// TUM sequences in files: clocks, repairs and the start of a reconstruction.
class RoomFiles : public testing::Test {
 protected:
  RoomFiles() { WriteRoomScan(Room(), folder()); }
  std::filesystem::path folder() const { return folder_.path() / "scan"; }
  std::filesystem::path repaired() const { return folder_.path() / "repaired"; }

  void ShiftClock(double seconds) {
    Trajectory trajectory = ReadTumTrajectory(folder() / "trajectory.txt", FailOnFinding());
    for (StampedPose& pose : trajectory) pose.timestamp += seconds;
    WriteTumTrajectory(folder() / "trajectory.txt", trajectory);
  }

  void InvertPoses() {
    Trajectory trajectory = ReadTumTrajectory(folder() / "trajectory.txt", FailOnFinding());
    for (StampedPose& pose : trajectory) pose.T_world_camera = pose.T_world_camera.inverse();
    WriteTumTrajectory(folder() / "trajectory.txt", trajectory);
  }

  // Named, repaired, and nothing left to complain about.
  void ExpectRepairable(const std::string& cause) {
    const CheckReport report = CheckSequence(folder(), NoProgress);
    EXPECT_TRUE(std::any_of(report.findings.begin(), report.findings.end(),
                            [&](const CheckFinding& f) { return f.cause == cause; }));
    ASSERT_TRUE(report.geometry.correction);
    WriteRepairedSequence(*report.geometry.correction, repaired());
    const CheckReport after = CheckSequence(repaired(), NoProgress);
    EXPECT_TRUE(after.geometry.fits);
    for (const CheckFinding& finding : after.findings) {
      if (finding.cause == "no-colour") continue;  // the room is drawn in grey
      EXPECT_EQ(finding.cause, "");
    }
  }

  TemporaryFolder folder_;
};

TEST_F(RoomFiles, ClocksThatDiffer) {
  ShiftClock(0.15);
  ExpectRepairable("clock-offset");
}

TEST_F(RoomFiles, ClocksOfAnotherTimeZone) {
  ShiftClock(3600.21);
  ExpectRepairable("clock-offset");
}

TEST_F(RoomFiles, ARepairLinksTheImages) {
  InvertPoses();
  ExpectRepairable("poses-inverted");
  EXPECT_TRUE(std::filesystem::is_symlink(repaired() / "depth/7.png"));
  EXPECT_TRUE(std::filesystem::is_symlink(repaired() / "rgb/7.png"));
  EXPECT_THROW(WriteRepairedSequence({OpenSequence(folder()), false, {}}, repaired()), Error);
}

TEST_F(RoomFiles, ARepairLeavesOutFramesWhoseImagesCannotBeRead) {
  std::filesystem::resize_file(folder() / "depth/7.png", 100);
  std::filesystem::remove(folder() / "rgb/9.png");
  for (const bool are_poses_wrong : {false, true}) {
    if (are_poses_wrong) InvertPoses();
    const CheckReport report = CheckSequence(folder(), NoProgress);
    EXPECT_TRUE(report.has_errors());
    ASSERT_TRUE(report.geometry.correction);
    EXPECT_EQ(report.geometry.correction->made.size(), are_poses_wrong ? 2u : 1u);
    WriteRepairedSequence(*report.geometry.correction, repaired());
    const CheckReport after = CheckSequence(repaired(), NoProgress);
    EXPECT_FALSE(after.has_errors());
    EXPECT_EQ(after.frames, kRoomFrames - 2);
    std::filesystem::remove_all(repaired());
  }
}

TEST_F(RoomFiles, ACopyMayLackDepthOrPoses) {
  Sequence sequence = OpenSequence(folder());
  WriteRepairedSequence({WithoutDepth(sequence), false, {}}, repaired());
  const Sequence copy = OpenSequence(repaired(), PoseUse::kNeeded, DepthUse::kIfGiven);
  EXPECT_FALSE(copy.has_depth);
  EXPECT_EQ(copy.frame_count(), kRoomFrames);
  std::filesystem::remove_all(repaired());
  sequence.has_poses = false;
  WriteRepairedSequence({sequence, false, {}}, repaired());
  EXPECT_FALSE(OpenSequence(repaired(), PoseUse::kIfGiven).has_poses);
}

TEST_F(RoomFiles, SwappedBytesAreWrittenAnew) {
  RoomScan wrong = Room();
  for (Image<uint16_t>& depth : wrong.thumbnails.depth) {
    for (size_t i = 0; i < depth.size(); ++i) {
      depth.data()[i] = static_cast<uint16_t>((depth.data()[i] << 8) | (depth.data()[i] >> 8));
    }
  }
  WriteRoomScan(wrong, folder());
  ExpectRepairable("depth-bytes-swapped");
  EXPECT_FALSE(std::filesystem::is_symlink(repaired() / "depth/7.png"));
}

TEST_F(RoomFiles, AReconstructionRefusesWhatCannotWork) {
  Sequence good = OpenSequence(folder());
  RequireFittingPoses(good);
  EXPECT_THAT(good.warnings, IsEmpty());
  InvertPoses();
  Sequence wrong = OpenSequence(folder());
  EXPECT_THROW(RequireFittingPoses(wrong), Error);
}

TEST_F(RoomFiles, DepthTellsTheScaleOfPoses) {
  Sequence scan = OpenSequence(folder());
  ASSERT_TRUE(ScaleByDepth(scan));
  EXPECT_NEAR(*ScaleByDepth(scan), 1, 0.002);
  for (SequenceFrame& frame : scan.frames) frame.T_world_camera.translation() *= 1.03;
  ASSERT_TRUE(ScaleByDepth(scan));
  EXPECT_NEAR(*ScaleByDepth(scan), 1 / 1.03, 0.002);
  for (SequenceFrame& frame : scan.frames) frame.T_world_camera.translation() *= 1.1;
  EXPECT_FALSE(ScaleByDepth(scan));  // farther off than what was tried
}

TEST_F(RoomFiles, FramesFarApartTellOfASingleJump) {
  const Sequence right = OpenSequence(folder());
  Sequence jumped = right;
  for (size_t i = jumped.frames.size() * 2 / 3; i < jumped.frames.size(); ++i) {
    jumped.frames[i].T_world_camera.pretranslate(Vec3(0.012, -0.006, 0.008));
  }
  const std::optional<DepthGain> gain = GainOfDepth(jumped, right);
  ASSERT_TRUE(gain);
  EXPECT_GT(gain->far, 1.5 * gain->near);
  Sequence sparse = jumped;
  const std::vector<int> compared = FramesOfGain(jumped);
  EXPECT_LT(compared.size(), jumped.frames.size());
  for (const int i : compared) sparse.frames[i].T_world_camera = right.frames[i].T_world_camera;
  const std::optional<DepthGain> of_some = GainOfDepth(jumped, sparse);
  ASSERT_TRUE(of_some);
  EXPECT_EQ(of_some->near, gain->near);
  EXPECT_EQ(of_some->far, gain->far);
  const std::optional<DepthGain> none = GainOfDepth(right, right);
  ASSERT_TRUE(none);
  EXPECT_EQ(none->near, 1);
  EXPECT_EQ(none->far, 1);
}

TEST(GeometryCheck, ACameraThatStandsTellsNoScale) {
  const TemporaryFolder files;
  WriteRoomScan(MakeRoomScan(0), files.path() / "scan");
  EXPECT_FALSE(ScaleByDepth(OpenSequence(files.path() / "scan")));
}

}  // namespace
}  // namespace curvefusion
