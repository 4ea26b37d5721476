#include "fusion/tracking/camera_tracker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fusion/tracking/track_sequence.h"
#include "kernel/error.h"
#include "kernel/rigid_motion.h"
#include "tests/capture/sequence_fixture.h"
#include "tests/fusion/analytic_depth.h"

namespace curvefusion {
namespace {

using testing::HasSubstr;

constexpr double kDegree = 0.017453292519943295;

// Two walls, a floor and two boxes, some 2 m away.
DepthAlongRay Room() {
  const DepthAlongRay walls =
      Union(Plane(Vec3::UnitZ(), 2.5), Union(Plane(Vec3::UnitX(), 1.2), Plane(Vec3::UnitY(), 0.9)));
  return Union(walls,
               Union(Box({-0.5, 0.3, 1.6}, {0, 0.9, 2}), Box({0.3, 0.1, 1.9}, {0.6, 0.9, 2.2})));
}

DepthAlongRay OtherRoom() {
  return Union(Plane(Vec3(0.6, 0, 0.8), 1.1),
               Union(Sphere({0.2, 0, 1}, 0.25), Plane(Vec3(-0.8, 0.6, 0), 0.5)));
}

// A pattern of patches of some 10 cm, fixed in the world.
double Pattern(const Vec3& p) {
  return std::sin(31 * p.x() + 2 * p.z()) * std::cos(27 * p.y() - 3 * p.x()) +
         std::sin(23 * p.z() + 5 * p.y());
}

struct Scene {
  DepthAlongRay shape;
  bool has_pattern = true;
};

TrackingCameras Cameras() { return {KinectCamera(0.5), KinectCamera(0.5)}; }

TrackingFrame Frame(const Scene& scene, const RigidTransform& T_world_camera, double time,
                    const TrackingOptions& options, double exposure = 1) {
  const PinholeCamera camera = Cameras().depth;
  const DepthImage depth = RenderDepth(scene.shape, camera, T_world_camera);
  ColorImage color;
  if (options.use_color) color = ColorImage(camera.width, camera.height, Rgb{100, 100, 100});
  for (int v = 0; v < color.height() && scene.has_pattern; ++v) {
    for (int u = 0; u < color.width(); ++u) {
      const Vec3 p = T_world_camera * camera.Unproject(u, v, depth(u, v));
      const auto grey =
          static_cast<uint8_t>(std::clamp(exposure * (100 + 40 * Pattern(p)), 0.0, 255.0));
      color(u, v) = {grey, grey, grey};
    }
  }
  TrackingFrame frame = MakeTrackingFrame(depth, color, Cameras(), options);
  frame.timestamp = time;
  return frame;
}

// A hand that sways: up to 12 mm and .9 degrees from frame to frame.
RigidTransform Sway(int frame) {
  const double t = 0.1 * frame;
  return RigidMotion(Vec3(0.08 * std::sin(1.1 * t), 0.12 * std::sin(0.9 * t), 0.05 * std::sin(t)),
                     Vec3(0.1 * std::sin(t), 0.03 * std::sin(1.3 * t), 0.08 * std::sin(0.7 * t)));
}

// Errors of rotations would grow threefold a frame without Orthonormal: 60 frames show it.
void ExpectTracked(const Scene& scene, const TrackingOptions& options, int frames,
                   double tolerance = 3 * kMillimetre) {
  CameraTracker tracker(Cameras(), options, Sway(0));
  for (int i = 0; i < frames; ++i) {
    const double exposure = i % 4 < 2 ? 1 : 1.25;
    const TrackedFrame tracked = tracker.Track(Frame(scene, Sway(i), i, options, exposure));
    ASSERT_TRUE(tracked.is_tracked) << i << ": " << tracked.why_lost;
    const RigidTransform error = Sway(i).inverse() * tracked.T_world_camera;
    // Voxels of 10 mm represent edges to some millimetres.
    EXPECT_LT(error.translation().norm(), tolerance) << i;
    EXPECT_LT(RotationVector(error).norm(), 0.15 * kDegree) << i;
  }
}

TEST(CameraTracker, AKnownMotionIsFoundToMillimetres) { ExpectTracked({Room()}, {}, 60); }

TEST(CameraTracker, DepthAloneFindsIt) {
  TrackingOptions options;
  options.use_color = false;
  ExpectTracked({Room()}, options, 60, 5 * kMillimetre);
}

TEST(CameraTracker, AFrameOfAnotherRoomIsLostAndTheNextOneFound) {
  const TrackingOptions options;
  CameraTracker tracker(Cameras(), options, Sway(0));
  for (int i = 0; i < 5; ++i) tracker.Track(Frame({Room()}, Sway(i), i, options));
  const TrackedFrame other = tracker.Track(Frame({OtherRoom()}, Sway(5), 5, options));
  EXPECT_FALSE(other.is_tracked);
  EXPECT_THAT(other.why_lost, HasSubstr(" %"));
  const TrackedFrame next = tracker.Track(Frame({Room()}, Sway(6), 6, options));
  ASSERT_TRUE(next.is_tracked) << next.why_lost;
  EXPECT_LT((Sway(6).inverse() * next.T_world_camera).translation().norm(), 3 * kMillimetre);
}

TEST(CameraTracker, ACameraThatWasTurnedAwayIsFoundByItsKeyframes) {
  const TrackingOptions options;
  CameraTracker tracker(Cameras(), options, Sway(0));
  for (int i = 0; i < 25; ++i) tracker.Track(Frame({Room()}, Sway(i), i, options));
  for (int i = 25; i < 30; ++i) {
    EXPECT_FALSE(tracker.Track(Frame({OtherRoom()}, Sway(i), i, options)).is_tracked);
  }
  const TrackedFrame back = tracker.Track(Frame({Room()}, Sway(1), 30, options));
  ASSERT_TRUE(back.is_tracked) << back.why_lost;
  EXPECT_LT((Sway(1).inverse() * back.T_world_camera).translation().norm(), 3 * kMillimetre);
}

TEST(CameraTracker, APlaneAloneIsDegenerateAndSaid) {
  TrackingOptions options;
  options.use_color = false;
  const Scene wall = {Plane(Vec3::UnitZ(), 1.5)};
  CameraTracker tracker(Cameras(), options, Sway(0));
  tracker.Track(Frame(wall, Sway(0), 0, options));
  const TrackedFrame tracked = tracker.Track(Frame(wall, Sway(1), 1, options));
  EXPECT_FALSE(tracked.is_tracked);
  EXPECT_THAT(tracked.why_lost, HasSubstr("leave the camera free to move"));
}

TEST(CameraTracker, ThePatternOfAPlaneHoldsTheCamera) {
  ExpectTracked({Plane(Vec3::UnitZ(), 1.5)}, {}, 10);
}

// Motions that another tracker gives, each a degree and some millimetres off, are put right by what
// the room shows.
TEST(CameraTracker, AGivenMotionIsCorrectedBySurfaces) {
  TrackingOptions options;
  options.use_color = false;
  CameraTracker tracker(Cameras(), options, Sway(0));
  tracker.Track(Frame({Room()}, Sway(0), 0, options));
  const RigidTransform off = RigidMotion(Vec3(0, kDegree, 0), Vec3(0.004, 0, 0));
  for (int i = 1; i < 20; ++i) {
    const RigidTransform motion = Sway(i - 1).inverse() * Sway(i) * (i % 2 ? off : off.inverse());
    const TrackedFrame tracked = tracker.TrackNear(Frame({Room()}, Sway(i), i, options), motion);
    ASSERT_TRUE(tracked.is_tracked) << i << ": " << tracked.why_lost;
    const RigidTransform error = Sway(i).inverse() * tracked.T_world_camera;
    EXPECT_LT(error.translation().norm(), 5 * kMillimetre) << i;
    EXPECT_LT(RotationVector(error).norm(), 0.3 * kDegree) << i;
  }
}

// Along a plane nothing is told: there the given motion stays.
TEST(CameraTracker, WhatSurfacesDoNotTellStaysAsGiven) {
  TrackingOptions options;
  options.use_color = false;
  const Scene wall = {Plane(Vec3::UnitZ(), 1.5)};
  CameraTracker tracker(Cameras(), options, RigidTransform::Identity());
  tracker.Track(Frame(wall, RigidTransform::Identity(), 0, options));
  const RigidTransform motion = RigidMotion(Vec3::Zero(), Vec3(0.01, 0.005, 0));
  const RigidTransform off = RigidMotion(Vec3::Zero(), Vec3(0, 0, 0.004));
  const TrackedFrame tracked = tracker.TrackNear(Frame(wall, motion, 1, options), motion * off);
  ASSERT_TRUE(tracked.is_tracked) << tracked.why_lost;
  EXPECT_NEAR(tracked.T_world_camera.translation().x(), 0.01, 0.5 * kMillimetre);
  EXPECT_NEAR(tracked.T_world_camera.translation().y(), 0.005, 0.5 * kMillimetre);
  EXPECT_NEAR(tracked.T_world_camera.translation().z(), 0, 1 * kMillimetre);
}

TEST(CameraTracker, AFrameWithoutDepthIsLost) {
  const TrackingOptions options;
  CameraTracker tracker(Cameras(), options, Sway(0));
  const Scene nothing = {[](const Vec3&, const Vec3&) { return 0.0; }, false};
  const TrackedFrame tracked = tracker.Track(Frame(nothing, Sway(0), 0, options));
  EXPECT_FALSE(tracked.is_tracked);
  EXPECT_THAT(tracked.why_lost, HasSubstr("0 % of its pixels have a depth"));
}

// Colour that comes half a frame later shows what the camera sees then.
TEST(ColorFromDepth, FollowsTheMotionSinceTheFrameBefore) {
  TrackingFrame frame;
  frame.timestamp = 2;
  frame.color_delay = 0.5;
  const RigidTransform T_world_frame = RigidMotion(Vec3::Zero(), Vec3(0.02, 0, 0));
  const RigidTransform T = ColorFromDepth(frame, {RigidTransform::Identity(), 1}, T_world_frame,
                                          RigidTransform::Identity());
  EXPECT_NEAR(T.translation().x(), -0.01, 1e-12);
}

// A bare wall that the camera faces: the folder says nothing but where it was at first.
TEST(TrackSequence, LostForGoodIsAnErrorThatNamesFrameAndRemedy) {
  const TemporaryFolder folder;
  WriteTumSequence(folder.path());
  const Sequence images = OpenSequence(folder.path(), PoseUse::kIgnored);
  ASSERT_EQ(images.frame_count(), kFixtureFrames);
  try {
    TrackSequence(images, RigidTransform::Identity(), {}, NoProgress);
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    EXPECT_THAT(error.what(), HasSubstr("3 of 4 frames: " + images.frames[1].name));
    EXPECT_THAT(error.what(), HasSubstr("move the camera slower"));
  }
}

}  // namespace
}  // namespace curvefusion
