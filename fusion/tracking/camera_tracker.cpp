#include "fusion/tracking/camera_tracker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fusion/tracking/rotation_alignment.h"
#include "kernel/rigid_motion.h"

namespace curvefusion {

namespace {

// Metres. Voxels of the tracker's own volume. Chosen on fr1_rpy and simulated scans: finer ones
// take longer and track no better.
constexpr double kVoxelSize = 0.01;
// Curless and Levoy 1996: more than the noise, which is 2 cm at 4 m.
constexpr int kTruncationVoxels = 4;
// Chosen: a lost camera is not followed for long, and each keyframe takes a whole alignment.
constexpr double kMaxExtrapolation = 3;  // intervals
constexpr int kKeyframesTried = 3;
// Chosen on fr1_rpy and simulated scans (docs/tracking.md#lost-frames).
constexpr double kMinMeasured = 0.05;  // of the pixels
constexpr double kMinOverlap = 0.3;    // of what was measured
constexpr double kMinInliers = 0.55;   // of the overlap
constexpr double kMaxDeviation = 3.5;  // standard deviations of the sensor's noise
constexpr double kMaxGrey = 0.5;       // deviation over contrast: images of unlike places have 1.4
constexpr double kMinContrast = 20;    // grey levels. Chosen: less says nothing beside noise
constexpr double kMaxUncertainty = 5 * kMillimetre;
// Standard deviations of the motion that another tracker gives from one frame to the next. Chosen:
// a third and three times as much place the camera about as well on 11 training scans.
constexpr double kGivenTranslation = 3 * kMillimetre;
constexpr double kGivenRotation = 0.3 * M_PI / 180;
// Where the motion is given: depth of stereo cameras lies within reach of the model here and there.
// Chosen: less than the 14 to 25 % of a D400 (docs/lab_notebook.md#poses-held-to-surfaces).
constexpr double kMinGivenOverlap = 0.05;

TsdfOptions VolumeOptions(const TrackingOptions& options) {
  TsdfOptions volume;
  volume.voxel_size = kVoxelSize;
  volume.truncation_voxels = kTruncationVoxels;
  volume.max_depth = options.max_depth;
  return volume;
}

// The share of the pixels of the finest level that have a depth.
double MeasuredShare(const TrackingFrame& frame) {
  const DepthImage& depth = frame.levels.front().depth;
  return static_cast<double>(CountMeasured(depth)) / static_cast<double>(depth.size());
}

TrackedFrame LostWithoutDepth(const TrackingFrame& frame) {
  TrackedFrame lost;
  lost.why_lost = fmt::format("{:.0f} % of its pixels have a depth, {:.0f} % are needed",
                              100 * MeasuredShare(frame), 100 * kMinMeasured);
  return lost;
}

bool IsBetter(const TrackedFrame& a, const TrackedFrame& b) {
  if (a.is_tracked != b.is_tracked) return a.is_tracked;
  return a.is_tracked && a.alignment.cost < b.alignment.cost;
}

}  // namespace

std::string WhyNotTrusted(const FrameAlignment& alignment, bool motion_is_given) {
  const double least_overlap = motion_is_given ? kMinGivenOverlap : kMinOverlap;
  const GeometricFit& fit = alignment.fit;
  if (fit.overlapping < least_overlap * fit.measured) {
    return fmt::format("{:.0f} % of its depth overlaps the model, {:.0f} % are needed",
                       100.0 * fit.overlapping / std::max(1, fit.measured), 100 * least_overlap);
  }
  if (fit.inliers < kMinInliers * fit.overlapping) {
    return fmt::format("{:.0f} % of the overlap are inliers, {:.0f} % are needed",
                       100.0 * fit.inliers / std::max(1, fit.overlapping), 100 * kMinInliers);
  }
  if (fit.deviation > kMaxDeviation) {
    return fmt::format(
        "depth differs from the model by {:.1f} times the noise, at most {:g} is "
        "trusted",
        fit.deviation, kMaxDeviation);
  }
  if (alignment.grey_contrast > kMinContrast &&
      alignment.grey_deviation > kMaxGrey * alignment.grey_contrast) {
    return fmt::format("grey differs from the keyframe by {:.0f} levels of a contrast of {:.0f}",
                       alignment.grey_deviation, alignment.grey_contrast);
  }
  if (!motion_is_given && !(alignment.uncertainty < kMaxUncertainty)) {
    return fmt::format(
        "the surfaces in view leave the camera free to move by {:.1f} mm, at most "
        "{:g} mm is trusted",
        alignment.uncertainty / kMillimetre, kMaxUncertainty / kMillimetre);
  }
  return "";
}

CameraTracker::CameraTracker(const TrackingCameras& cameras, const TrackingOptions& options,
                             const RigidTransform& T_world_start)
    : cameras_(cameras), T_world_start_(T_world_start), volume_(VolumeOptions(options)) {}

TrackedFrame CameraTracker::Track(const TrackingFrame& frame) {
  if (MeasuredShare(frame) < kMinMeasured) return LostWithoutDepth(frame);
  if (!before_) return Start(frame);
  TrackedFrame tracked = TryFrom(frame, Guesses(frame));
  if (!tracked.is_tracked || was_lost_) {
    const TrackedFrame again = TryFromKeyframes(frame);
    if (IsBetter(again, tracked)) tracked = again;
  }
  was_lost_ = !tracked.is_tracked;
  if (tracked.is_tracked) Add(frame, tracked.T_world_camera);
  return tracked;
}

TrackedFrame CameraTracker::TrackNear(const TrackingFrame& frame,
                                      const RigidTransform& T_before_now) {
  if (MeasuredShare(frame) < kMinMeasured) return LostWithoutDepth(frame);
  if (!before_) return Start(frame);
  const PosePrior prior = {before_->pose.T_world_camera * T_before_now, kGivenTranslation,
                           kGivenRotation};
  const TrackedFrame tracked = TryFrom(frame, {prior.T_world_camera}, &prior);
  if (tracked.is_tracked) Add(frame, tracked.T_world_camera);
  return tracked;
}

TrackedFrame CameraTracker::Start(const TrackingFrame& frame) {
  Add(frame, T_world_start_);
  TrackedFrame tracked;
  tracked.is_tracked = true;
  tracked.T_world_camera = T_world_start_;
  return tracked;
}

// Hands shake: the camera may go on as before, turn as the images say, or stand.
std::vector<RigidTransform> CameraTracker::Guesses(const TrackingFrame& frame) const {
  double share = 0;
  const double elapsed = frame.timestamp - before_->pose.timestamp;
  if (before_->interval > 0) share = elapsed / before_->interval;
  if (share > kMaxExtrapolation) share = 0;
  const RigidTransform& T_world_before = before_->pose.T_world_camera;
  const RigidTransform T_before_now = RigidMotion(share * RotationVector(before_->velocity),
                                                  share * before_->velocity.translation());
  std::vector<RigidTransform> guesses = {T_world_before * T_before_now};
  const FrameLevel& coarsest = frame.levels.back();
  if (!coarsest.grey.empty()) {
    guesses.push_back(T_world_before * RotationByGrey(before_->coarsest, coarsest, T_before_now));
    guesses.push_back(T_world_before *
                      RotationByGrey(before_->coarsest, coarsest, RigidTransform::Identity()));
  }
  guesses.push_back(T_world_before);
  return guesses;
}

TrackedFrame CameraTracker::TryFrom(const TrackingFrame& frame,
                                    const std::vector<RigidTransform>& T_world_guesses,
                                    const PosePrior* prior) const {
  const ModelView model =
      RenderModel(volume_, frame.levels.front().depth_camera, T_world_guesses.front());
  const KeyframeMap::Entry* nearest =
      frame.levels.front().grey.empty() ? nullptr : keyframes_.Nearest(T_world_guesses.front());
  TrackedFrame tracked;
  tracked.alignment = AlignFrame(frame, model, nearest == nullptr ? nullptr : &nearest->keyframe,
                                 before_->pose, cameras_.T_color_depth, T_world_guesses, prior);
  tracked.why_lost = WhyNotTrusted(tracked.alignment, prior != nullptr);
  tracked.is_tracked = tracked.why_lost.empty();
  tracked.T_world_camera = tracked.alignment.T_world_camera;
  return tracked;
}

TrackedFrame CameraTracker::TryFromKeyframes(const TrackingFrame& frame) const {
  const FrameLevel& coarsest = frame.levels.back();
  if (coarsest.grey.empty()) return {};
  TrackedFrame best;
  for (const KeyframeMap::Entry* entry : keyframes_.MostAlike(coarsest, kKeyframesTried)) {
    const RigidTransform T_keyframe_now =
        RotationByGrey(entry->coarsest, coarsest, RigidTransform::Identity());
    TrackedFrame tracked = TryFrom(frame, {entry->keyframe.T_world_camera * T_keyframe_now});
    if (IsBetter(tracked, best)) best = std::move(tracked);
  }
  return best;
}

void CameraTracker::Add(const TrackingFrame& frame, const RigidTransform& T_world_camera) {
  const FrameLevel& finest = frame.levels.front();
  volume_.Integrate(finest.depth, finest.depth_camera, T_world_camera);
  Before now;
  now.pose = {T_world_camera, frame.timestamp};
  now.coarsest = frame.levels.back();
  RigidTransform T_color_depth = cameras_.T_color_depth;
  if (before_) {
    now.velocity = before_->pose.T_world_camera.inverse() * T_world_camera;
    now.interval = frame.timestamp - before_->pose.timestamp;
    T_color_depth = ColorFromDepth(frame, before_->pose, T_world_camera, T_color_depth);
  }
  if (!finest.grey.empty()) keyframes_.AddIfNew(frame, T_world_camera, T_color_depth);
  before_ = std::move(now);
}

}  // namespace curvefusion
