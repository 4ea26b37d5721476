#include "fusion/frame_registration.h"

#include <algorithm>
#include <cassert>
#include <optional>

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

// The correction of a frame given a first one; nothing where it sees too little of the curves.
std::optional<RigidTransform> RegisterFrame(const ObservedPoints& frame, const RigidTransform& T,
                                            const RidgePoints& curves,
                                            const AlignmentOptions& alignment,
                                            const FrameRegistrationOptions& options) {
  if (static_cast<int>(frame.size()) < options.min_points) return std::nullopt;
  const AlignmentResult result = AlignPointsToPoints(
      Transformed(frame, T).positions, curves.positions, curves.directions, alignment);
  if (result.inlier_fraction < options.min_inliers) return std::nullopt;
  return result.T_target_source * T;
}

// Frames without a correction of their own take that of the one before, or the next one.
int FillFromNeighbours(const std::vector<std::optional<RigidTransform>>& registered,
                       std::vector<RigidTransform>& T) {
  int count = 0;
  std::optional<size_t> last;
  for (size_t i = 0; i < registered.size(); ++i) {
    if (registered[i]) {
      T[i] = *registered[i];
      ++count;
      if (!last) std::fill(T.begin(), T.begin() + static_cast<std::ptrdiff_t>(i), T[i]);
      last = i;
    } else if (last) {
      T[i] = T[*last];
    }
  }
  return count;
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
}

RegisteredFrames RegisterFrames(const std::vector<ObservedPoints>& frames,
                                const std::vector<RigidTransform>& start,
                                const RidgeProjectionOptions& ridges,
                                const AlignmentOptions& alignment,
                                const FrameRegistrationOptions& options) {
  assert(frames.size() == start.size());
  RegisteredFrames result;
  result.T_registered_world = start;
  std::vector<RigidTransform>& T = result.T_registered_world;
  for (int round = 0; round < options.rounds; ++round) {
    const RidgePoints curves = ProjectToRidges(Merged(frames, T, options.voxel_size), ridges);
    std::vector<std::optional<RigidTransform>> registered(frames.size());
    ParallelFor(0, static_cast<int64_t>(frames.size()), 1, [&](int64_t i) {
      registered[i] = RegisterFrame(frames[i], T[i], curves, alignment, options);
    });
    result.registered = FillFromNeighbours(registered, T);
  }
  if (!T.empty()) {
    const RigidTransform T_anchor = T.front().inverse();
    for (RigidTransform& correction : T) correction = T_anchor * correction;
  }
  result.points = Merged(frames, T, options.voxel_size);
  return result;
}

}  // namespace curvefusion
