#include "fusion/segmentation.h"

#include <algorithm>
#include <vector>

#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Frames segmented at the same time: enough to keep the cores busy, few enough to bound memory.
constexpr int kFramesAtOnce = 8;

struct SegmentedFrame {
  DepthImage depth;
  MaskImage mask;
  MaskImage on_edge;
};

SegmentedFrame SegmentFrame(const Sequence& sequence, int frame, const TsdfVolume& volume,
                            const SegmentationOptions& options) {
  SegmentedFrame segmented;
  segmented.depth = LoadDepth(sequence, frame);
  const PinholeCamera small = sequence.depth_camera.Scaled(1.0 / options.render_divisor);
  const RigidTransform& T_world_camera = sequence.frames[frame].T_world_camera;
  const DepthImage rendering = volume.Raycast(small, T_world_camera);
  const double solid_depth = options.opening.solid_depth;
  const DepthImage solidity =
      solid_depth > 0 ? volume.SolidityBehind(rendering, small, T_world_camera, solid_depth)
                      : DepthImage();
  const DepthImage kept = OpenDepth(rendering, small, solidity, options.opening);
  segmented.mask = ImageDifferenceSet(segmented.depth, rendering, kept, options.difference);
  const MaskImage edges = ColourEdges(LoadColor(sequence, frame), options.edges);
  segmented.on_edge =
      MaskPixelsOnEdges(segmented.mask, segmented.depth, edges, sequence.depth_camera,
                        sequence.color_camera, sequence.T_color_depth, options.edges);
  return segmented;
}

}  // namespace

void VisitOptions(SegmentationOptions& options, OptionVisitor& visitor) {
  visitor.BeginSection("segmentation");
  visitor.Visit(
      {"render_divisor", "", 1, 8,
       "Deviation: the volume is rendered with so many times fewer rows and columns; it only "
       "holds large surfaces."},
      options.render_divisor);
  VisitOptions(options.opening, visitor);
  VisitOptions(options.difference, visitor);
  visitor.BeginSection("bundle");
  VisitOptions(options.bundle, visitor);
  visitor.BeginSection("ghosts");
  VisitOptions(options.edges, visitor);
  VisitOptions(options.ghosts, visitor);
}

SegmentedBundle SegmentBundle(const Sequence& sequence, int first, int last,
                              const TsdfVolume& volume, const SegmentationOptions& options) {
  SegmentedBundle segmented;
  segmented.T_world_bundle = sequence.frames[first].T_world_camera;
  BundleDifferenceSet difference_set(options.bundle);
  std::vector<SegmentedFrame> window(kFramesAtOnce);
  for (int start = first; start < last; start += kFramesAtOnce) {
    const int end = std::min(start + kFramesAtOnce, last);
    ParallelFor(start, end, 1, [&](int64_t frame) {
      window[frame - start] = SegmentFrame(sequence, static_cast<int>(frame), volume, options);
    });
    for (int frame = start; frame < end; ++frame) {
      const SegmentedFrame& current = window[frame - start];
      difference_set.AddFrame(
          current.mask, current.on_edge, current.depth, sequence.depth_camera,
          segmented.T_world_bundle.inverse() * sequence.frames[frame].T_world_camera);
    }
  }
  BundlePoints candidates = difference_set.Points();
  BundlePoints remaining = RemoveGhosts(candidates, options.ghosts);
  segmented.frames = difference_set.FramePoints(remaining.voxels);
  segmented.difference_set = std::move(candidates.points);
  segmented.points = std::move(remaining.points);
  return segmented;
}

}  // namespace curvefusion
