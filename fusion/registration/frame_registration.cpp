#include "fusion/registration/frame_registration.h"

#include <algorithm>
#include <cassert>

#include "kernel/parallel.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

namespace {

// So many points of a frame are looked at for one that is aligned. Chosen: most may lie between
// wires.
constexpr size_t kCandidatesPerPoint = 4;
// Chosen: a frame of which a smaller share fits the curves, or with fewer points near them, is not
// moved by itself;
constexpr double kMinInliers = 0.5;
constexpr int kMinPoints = 100;
// nor one that would move farther, metres; chosen: the largest drift within a bundle.
constexpr double kMaxMotion = 0.01;

// Metres, of the grid on which points are merged; chosen: as carried_voxel_size.
constexpr double kVoxelSize = 0.0025;

// The points of a frame, moved, that lie near the curves. Where wires are dense, block matching
// makes one sheet of them, and most points lie between them and say nothing.
std::vector<Vec3> PointsNear(const AlignmentTarget& curves, const ObservedPoints& frame,
                             const RigidTransform& T, size_t enough, double reach) {
  std::vector<Vec3> near;
  const size_t stride = std::max<size_t>(1, frame.size() / enough);
  for (size_t i = 0; i < frame.size(); i += stride) {
    const Vec3 p = T * frame.positions[i];
    if (curves.grid().Nearest(p, reach) >= 0) near.push_back(p);
  }
  return near;
}

// The correction of a frame given a first one; without information where it sees too little of the
// curves.
MeasuredCorrection RegisterFrame(const ObservedPoints& frame, const RigidTransform& T,
                                 const AlignmentTarget& curves, const AlignmentOptions& alignment,
                                 const FrameRegistrationOptions& options) {
  MeasuredCorrection correction;
  correction.T_registered_world = T;
  const std::vector<Vec3> points =
      PointsNear(curves, frame, T, kCandidatesPerPoint * alignment.max_points, options.reach);
  if (static_cast<int>(points.size()) < kMinPoints) return correction;
  const AlignmentResult result = AlignPoints(points, curves, alignment);
  // One frame on the wrong curves would draw its neighbours after it.
  const double moved = (result.T_target_source.inverse() * result.center - result.center).norm();
  if (result.inlier_fraction < kMinInliers || moved > kMaxMotion) return correction;
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
  visitor.Visit({"frame_reach", "m", 0.0005, 1,
                 "Deviation: points of a frame farther from the curves are not registered: they "
                 "lie between wires."},
                options.reach);
  VisitOptions(options.drift, visitor);
}

RegisteredFrames RegisterFrames(const std::vector<ObservedPoints>& frames,
                                const std::vector<RigidTransform>& start,
                                const std::vector<Vec3>& cameras, RidgePoints ridge,
                                const RidgeProjectionOptions& ridges,
                                const AlignmentOptions& alignment,
                                const FrameRegistrationOptions& options) {
  assert(frames.size() == start.size() && frames.size() == cameras.size());
  RegisteredFrames result;
  result.T_registered_world = start;
  std::vector<RigidTransform>& T = result.T_registered_world;
  for (int round = 0; round < options.rounds; ++round) {
    ridge = FollowRidges(ResampleOnGrid(frames, T, kVoxelSize), ridge, ridges);
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
  result.points = ResampleOnGrid(frames, T, kVoxelSize);
  return result;
}

}  // namespace curvefusion
