#include "fusion/frame_registration.h"

#include <algorithm>
#include <cassert>

#include "kernel/parallel.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

namespace {

ObservedPoints Merged(const std::vector<ObservedPoints>& frames,
                      const std::vector<RigidTransform>& T, double voxel_size) {
  ObservedPoints merged;
  for (size_t i = 0; i < frames.size(); ++i) Append(merged, Transformed(frames[i], T[i]));
  return ResampleOnGrid(merged, voxel_size);
}

// The correction of a frame given a first one; without information where it sees too little of the
// curves.
MeasuredCorrection RegisterFrame(const ObservedPoints& frame, const RigidTransform& T,
                                 const AlignmentTarget& curves, const AlignmentOptions& alignment,
                                 const FrameRegistrationOptions& options) {
  MeasuredCorrection correction;
  correction.T_registered_world = T;
  if (static_cast<int>(frame.size()) < options.min_points) return correction;
  const AlignmentResult result = AlignPoints(Transformed(frame, T).positions, curves, alignment);
  // One frame on the wrong curves would draw its neighbours after it.
  const double moved = (result.T_target_source.inverse() * result.center - result.center).norm();
  if (result.inlier_fraction < options.min_inliers || moved > options.max_motion) return correction;
  correction.T_registered_world = result.T_target_source * T;
  correction.information = result.information;
  correction.center = result.center;
  return correction;
}

}  // namespace

void VisitOptions(FrameRegistrationOptions& options, OptionVisitor& visitor) {
  visitor.Visit(
      {"rounds", "", 0, 10,
       "Deviation: how often all frames are registered to the curves, one by one; 0 leaves "
       "it at whole bundles."},
      options.rounds);
  visitor.Visit({"frame_min_inliers", "", 0, 1,
                 "A frame of which a smaller share fits the curves is not moved by itself."},
                options.min_inliers);
  visitor.Visit({"frame_min_points", "points", 6, 100000,
                 "A frame with fewer points is not moved by itself."},
                options.min_points);
  visitor.Visit({"frame_max_motion", "m", 0, 1,
                 "A frame that would move farther from its bundle is not moved by itself: the "
                 "largest drift within a bundle."},
                options.max_motion);
  VisitOptions(options.drift, visitor);
}

RegisteredFrames RegisterFrames(const std::vector<ObservedPoints>& frames,
                                const std::vector<RigidTransform>& start,
                                const std::vector<Vec3>& cameras,
                                const RidgeProjectionOptions& ridges,
                                const AlignmentOptions& alignment,
                                const FrameRegistrationOptions& options) {
  assert(frames.size() == start.size() && frames.size() == cameras.size());
  RegisteredFrames result;
  result.T_registered_world = start;
  std::vector<RigidTransform>& T = result.T_registered_world;
  for (int round = 0; round < options.rounds; ++round) {
    const RidgePoints ridge = ProjectToRidges(Merged(frames, T, options.voxel_size), ridges);
    const AlignmentTarget curves({ridge.positions, ridge.directions});
    std::vector<MeasuredCorrection> measured(frames.size());
    ParallelFor(0, static_cast<int64_t>(frames.size()), 1, [&](int64_t i) {
      measured[i] = RegisterFrame(frames[i], T[i], curves, alignment, options);
      measured[i].camera = cameras[i];
    });
    result.registered = static_cast<int>(
        std::count_if(measured.begin(), measured.end(),
                      [](const MeasuredCorrection& m) { return !m.information.isZero(); }));
    if (result.registered == 0) break;
    T = SmoothCorrections(measured, options.drift);
  }
  if (!T.empty()) {
    const RigidTransform T_anchor = T.front().inverse();
    for (RigidTransform& correction : T) correction = T_anchor * correction;
  }
  result.points = Merged(frames, T, options.voxel_size);
  return result;
}

}  // namespace curvefusion
