#include "fusion/segmentation.h"

#include <algorithm>
#include <vector>

#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Frames segmented at the same time: enough to keep the cores busy, few enough to bound memory.
constexpr int kFramesAtOnce = 8;

struct SegmentedFrame {
  WireCandidates candidates;
  MaskImage on_edge;
};

// Grilles are seen through.
void MarkOpen(const MaskImage& grilles, DepthImage& solidity) {
  if (solidity.empty()) solidity = DepthImage(grilles.width(), grilles.height(), 1);
  for (size_t i = 0; i < grilles.size(); ++i) {
    if (grilles.data()[i]) solidity.data()[i] = 0;
  }
}

// Depth pixels that the volume does not explain, CurveFusion 3.1 "Removing large surfaces".
WireCandidates FindCandidates(const Sequence& sequence, int frame, const TsdfVolume& volume,
                              const OpennessGrid& openness, const SegmentationOptions& options) {
  WireCandidates found;
  found.depth = LoadDepth(sequence, frame);
  found.color = LoadColor(sequence, frame);
  const PinholeCamera small = sequence.depth_camera.Scaled(1.0 / options.render_divisor);
  const RigidTransform& T_world_camera = sequence.frames[frame].T_world_camera;
  const DepthImage rendering = volume.Raycast(small, T_world_camera);
  const double solid_depth = options.opening.solid_depth;
  DepthImage solidity = solid_depth > 0
                            ? volume.SolidityBehind(rendering, small, T_world_camera, solid_depth)
                            : DepthImage();
  found.rows = openness.Grilles(rendering, small, T_world_camera);
  if (options.openness.stride > 0) MarkOpen(found.rows, solidity);
  const DepthImage kept = OpenDepth(rendering, small, solidity, options.opening);
  found.mask = ImageDifferenceSet(found.depth, rendering, kept, options.difference);
  return found;
}

SegmentedFrame SegmentFrame(const Sequence& sequence, int frame, const TsdfVolume& volume,
                            const SegmentationModel& model, const SegmentationOptions& options) {
  SegmentedFrame segmented;
  segmented.candidates = FindCandidates(sequence, frame, volume, model.openness, options);
  WireCandidates& candidates = segmented.candidates;
  if (options.gate.frames > 0) GateByColour(model.colours, sequence, options.gate, candidates);
  const MaskImage edges = ColourEdges(candidates.color, options.edges);
  segmented.on_edge =
      MaskPixelsOnEdges(candidates.mask, candidates.depth, edges, sequence.depth_camera,
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
  VisitOptions(options.openness, visitor);
  VisitOptions(options.difference, visitor);
  VisitOptions(options.gate, visitor);
  visitor.BeginSection("bundle");
  VisitOptions(options.bundle, visitor);
  visitor.BeginSection("ghosts");
  VisitOptions(options.edges, visitor);
  VisitOptions(options.ghosts, visitor);
}

SegmentationModel LearnSegmentation(const Sequence& sequence, const TsdfVolume& volume,
                                    const SegmentationOptions& options) {
  SegmentationModel model{MeasureOpenness(sequence, volume, options.openness), {}};
  if (options.gate.frames == 0) return model;
  const int frame_count = sequence.frame_count();
  std::vector<WireCandidates> frames(std::min(options.gate.frames, frame_count));
  const auto count = static_cast<int64_t>(frames.size());
  ParallelFor(0, count, 1, [&](int64_t i) {
    frames[i] = FindCandidates(sequence, static_cast<int>(i * frame_count / count), volume,
                               model.openness, options);
  });
  model.colours = LearnWireColours(frames, sequence, options.gate);
  return model;
}

SegmentedBundle SegmentBundle(const Sequence& sequence, int first, int last,
                              const TsdfVolume& volume, const SegmentationModel& model,
                              const SegmentationOptions& options) {
  SegmentedBundle segmented;
  segmented.T_world_bundle = sequence.frames[first].T_world_camera;
  BundleDifferenceSet difference_set(options.bundle);
  std::vector<SegmentedFrame> window(kFramesAtOnce);
  for (int start = first; start < last; start += kFramesAtOnce) {
    const int end = std::min(start + kFramesAtOnce, last);
    ParallelFor(start, end, 1, [&](int64_t frame) {
      window[frame - start] =
          SegmentFrame(sequence, static_cast<int>(frame), volume, model, options);
    });
    for (int frame = start; frame < end; ++frame) {
      const SegmentedFrame& current = window[frame - start];
      difference_set.AddFrame(
          current.candidates.mask, current.on_edge, current.candidates.depth, sequence.depth_camera,
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
