#include "fusion/segmentation/segmentation.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

#include "capture/frame_stream.h"
#include "fusion/segmentation/colour_verification.h"
#include "fusion/segmentation/sheet_stripes.h"
#include "kernel/parallel.h"
#include "kernel/thinned.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

namespace {

// Chosen: from so many frames it is told whether depth shows a background.
constexpr int kBackgroundFrames = 10;
// Chosen: frames segmented at the same time, enough to keep the cores busy, few enough to bound
// memory.
constexpr size_t kFramesAtOnce = 8;
// Of floating sheets. Chosen: arrays of parallel wires have stripes on .86 and more of their area,
// shelves of a rack on .47, a cage on .20 (docs/close_wires.md#what-it-does).
constexpr double kMinStripedShare = 0.7;
// Chosen, in pixels: the outermost wires of a wire array, and what block matching fattens them by,
// lie so far beyond what the volume shows of it.
constexpr int kWireArrayMargin = 16;
// Chosen, where frames show very many points: five chairs take four fifths of the time and lose
// .001 of F2 (docs/lab_notebook.md#time-and-frames-left-out).
constexpr int kCrowdedStride = 2;

struct SegmentedFrame {
  WireCandidates candidates;
  MaskImage on_edge;
  PointFunnel funnel;  // of its pixels
};

int64_t CountSet(const MaskImage& mask) {
  return std::count_if(mask.data(), mask.data() + mask.size(), [](uint8_t set) { return set; });
}

// Mean of the largest less the least of R, G and B, of every 64th pixel.
double Chroma(const ColorImage& color) {
  constexpr int kStep = 8;  // chosen: enough for a mean
  int64_t sum = 0, count = 0;
  for (int v = 0; v < color.height(); v += kStep) {
    for (int u = 0; u < color.width(); u += kStep) {
      const auto& pixel = color(u, v);
      const auto [least, most] = std::minmax({pixel[0], pixel[1], pixel[2]});
      sum += most - least;
      ++count;
    }
  }
  return count > 0 ? static_cast<double>(sum) / static_cast<double>(count) : 0;
}

// Grilles are seen through.
void MarkOpen(const MaskImage& grilles, DepthImage& solidity) {
  if (solidity.empty()) solidity = DepthImage(grilles.width(), grilles.height(), 1);
  for (size_t i = 0; i < grilles.size(); ++i) {
    if (grilles.data()[i]) solidity.data()[i] = 0;
  }
}

void AddArrays(const MaskImage& more, MaskImage& arrays) {
  for (size_t i = 0; i < arrays.size(); ++i) arrays.data()[i] |= more.data()[i];
}

PinholeCamera RenderingCamera(const Sequence& sequence, const SegmentationOptions& options) {
  return sequence.depth_camera.Scaled(1.0 / options.render_divisor);
}

DepthImage Rendering(const Sequence& sequence, int frame, const TsdfVolume& volume,
                     const SegmentationOptions& options) {
  return volume.Raycast(RenderingCamera(sequence, options), sequence.frames[frame].T_world_camera);
}

// Depth pixels that the volume does not explain, CurveFusion 4.1 "Removing large surfaces".
WireCandidates FindCandidates(const Sequence& sequence, int frame, const DepthImage& rendering,
                              const TsdfVolume& volume, const SegmentationModel& model,
                              const SegmentationOptions& options) {
  WireCandidates found;
  found.depth = LoadDepth(sequence, frame);
  found.color = LoadColor(sequence, frame);
  const PinholeCamera small = RenderingCamera(sequence, options);
  const RigidTransform& T_world_camera = sequence.frames[frame].T_world_camera;
  const double solid_depth = options.opening.solid_depth;
  DepthImage solidity = solid_depth > 0
                            ? volume.SolidityBehind(rendering, small, T_world_camera, solid_depth)
                            : DepthImage();
  found.arrays = model.openness.Grilles(rendering, small, T_world_camera);
  AddArrays(model.sheets.Mask(rendering, small, T_world_camera), found.arrays);
  if (model.array_spacing > 0) found.array_margin = kWireArrayMargin;
  if (options.openness_stride > 0) MarkOpen(found.arrays, solidity);
  const DepthImage kept = OpenDepth(rendering, small, solidity, options.opening);
  DifferenceSetOptions difference = options.difference;
  if (!model.is_background_measured) difference.accept_where_nothing_rendered = true;
  found.mask = ImageDifferenceSet(found.depth, rendering, kept, difference);
  return found;
}

SegmentedFrame SegmentFrame(const Sequence& sequence, int frame, const TsdfVolume& volume,
                            const SegmentationModel& model, const SegmentationOptions& options) {
  SegmentedFrame segmented;
  segmented.candidates = FindCandidates(
      sequence, frame, Rendering(sequence, frame, volume, options), volume, model, options);
  WireCandidates& candidates = segmented.candidates;
  segmented.funnel.frames = 1;
  segmented.funnel.chroma = Chroma(candidates.color);
  segmented.funnel.depth_pixels = CountMeasured(candidates.depth);
  segmented.funnel.thin_pixels = CountSet(candidates.mask);
  if (options.gate.frames > 0) GateByColour(model.colours, sequence, options.gate, candidates);
  const MaskImage edges = ColourEdges(candidates.color);
  segmented.on_edge =
      MaskPixelsOnEdges(candidates.mask, candidates.depth, edges, sequence.depth_camera,
                        sequence.color_camera, sequence.T_color_depth, options.edge_tolerance_px);
  if (model.array_spacing > 0) ThinToCrests(model.colours, sequence, candidates);
  segmented.funnel.gated_pixels = CountSet(candidates.mask);
  return segmented;
}

double Mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Of all pixels of the depth images.
double MeasuredShare(const Sequence& sequence, const std::vector<int>& frames) {
  std::vector<double> shares(frames.size());
  ParallelFor(0, static_cast<int64_t>(frames.size()), 1, [&](int64_t i) {
    const DepthImage depth = LoadDepth(sequence, frames[i]);
    shares[i] = static_cast<double>(CountMeasured(depth)) / static_cast<double>(depth.size());
  });
  return Mean(shares);
}

// The frames that are learned from, with what the volume shows in them.
struct LearnedFrames {
  std::vector<int> frames;
  std::vector<DepthImage> renderings;
};

LearnedFrames Render(const Sequence& sequence, const std::vector<int>& frames,
                     const TsdfVolume& volume, const SegmentationOptions& options) {
  LearnedFrames learned{frames, std::vector<DepthImage>(frames.size())};
  ParallelFor(0, static_cast<int64_t>(frames.size()), 1, [&](int64_t i) {
    learned.renderings[i] = Rendering(sequence, frames[i], volume, options);
  });
  return learned;
}

std::vector<WireCandidates> CandidatesOf(const Sequence& sequence, const LearnedFrames& learned,
                                         const TsdfVolume& volume, const SegmentationModel& model,
                                         const SegmentationOptions& options) {
  std::vector<WireCandidates> candidates(learned.frames.size());
  ParallelFor(0, static_cast<int64_t>(candidates.size()), 1, [&](int64_t i) {
    candidates[i] =
        FindCandidates(sequence, learned.frames[i], learned.renderings[i], volume, model, options);
  });
  return candidates;
}

// Large surfaces that float in space.
SheetGrid FindSheets(const Sequence& sequence, const LearnedFrames& learned,
                     const SegmentationOptions& options) {
  const PinholeCamera small = RenderingCamera(sequence, options);
  std::vector<MaskImage> floating(learned.frames.size());
  ParallelFor(0, static_cast<int64_t>(floating.size()), 1, [&](int64_t i) {
    const DepthImage& rendering = learned.renderings[i];
    floating[i] = FloatingSheets(OpenDepth(rendering, small, {}, options.opening), rendering);
  });
  SheetGrid sheets;
  for (size_t i = 0; i < floating.size(); ++i) {
    sheets.AddFrame(floating[i], learned.renderings[i], small,
                    sequence.frames[learned.frames[i]].T_world_camera);
  }
  sheets.Pool();
  return sheets;
}

// Of the voxels of bundles those that a frame sees, on average. `candidates` are gated.
double PointsPerFrame(const Sequence& sequence, const WireColours& colours,
                      const SegmentationOptions& options, std::vector<WireCandidates>& candidates) {
  std::vector<double> points(candidates.size());
  ParallelFor(0, static_cast<int64_t>(candidates.size()), 1, [&](int64_t i) {
    WireCandidates& frame = candidates[i];
    GateByColour(colours, sequence, options.gate, frame);
    VoxelNumbers voxels;
    for (int v = 0; v < frame.mask.height(); ++v) {
      for (int u = 0; u < frame.mask.width(); ++u) {
        if (!frame.mask(u, v)) continue;
        const Vec3 p_camera = sequence.depth_camera.Unproject(u, v, frame.depth(u, v));
        voxels.Number(VoxelOf(p_camera, options.bundle.voxel_size));
      }
    }
    points[i] = voxels.size();
  });
  return Mean(points);
}

void SetArrayMargin(int margin, std::vector<WireCandidates>& candidates) {
  for (WireCandidates& frame : candidates) frame.array_margin = margin;
}

// Learns the colours of close wires; false where the colours show no stripes in them.
bool LearnWireArrays(const Sequence& sequence, const SegmentationOptions& options,
                     std::vector<WireCandidates>& candidates, SegmentationModel& model) {
  const auto has_arrays = [](const WireCandidates& frame) { return AnySet(frame.arrays); };
  if (std::none_of(candidates.begin(), candidates.end(), has_arrays)) return false;
  SetArrayMargin(kWireArrayMargin, candidates);
  WireColours colours = LearnWireColours(candidates, sequence, options.gate);
  SharpenColours(candidates, sequence, colours);
  const SheetStripes stripes =
      MeasureStripes(candidates, colours, sequence, options.max_array_spacing);
  if (stripes.share < kMinStripedShare) return false;
  model.array_spacing = stripes.spacing;
  model.array_diameter = stripes.width;
  model.colours = std::move(colours);
  return true;
}

// Adds the wires of nets, which depth shows as one surface; what each frame saw goes to `frames`.
// Pixels count as on an edge: it is colour that found them.
void AddNetWires(const Sequence& sequence, int first, int last, const Nets& nets,
                 const RigidTransform& T_bundle_world, BundleDifferenceSet& difference_set,
                 std::vector<int>& frames) {
  if (nets.empty()) return;
  for (const NetWires& wires : FindNetWires(sequence, first, last, nets)) {
    difference_set.AddFrame(wires.mask, wires.mask, wires.depth, sequence.depth_camera,
                            T_bundle_world * wires.T_world_camera);
    frames.push_back(wires.frame);
  }
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
  visitor.Visit({"openness_stride", "frames", 0, 1000,
                 "Deviation: every so many-th frame is asked whether its depth passes through "
                 "what the volume holds for a surface; 0 = not asked."},
                options.openness_stride);
  VisitOptions(options.difference, visitor);
  visitor.Visit({"min_measured_share", "", 0, 1,
                 "Deviation: where fewer of all pixels of the depth images are measured, what is "
                 "behind the wires is out of range or cut off, and pixels where nothing is "
                 "rendered belong to the set; 0 = never."},
                options.min_measured_share);
  VisitOptions(options.gate, visitor);
  visitor.Visit(
      {"max_array_spacing", "m", 0, 0.1,
       "Deviation: surfaces that float in space and have straight stripes of wire colour "
       "no farther apart than this are wire arrays; 0 = neither these nor nets are sought."},
      options.max_array_spacing);
  visitor.Visit(
      {"max_frame_points", "points", 0, 1000000,
       "Deviation: where the frames of a video show more points of wires than this, on "
       "average, every second is left out: its neighbours see the same wires. 0 = never."},
      options.max_frame_points);
  visitor.BeginSection("bundle");
  VisitOptions(options.bundle, visitor);
  visitor.BeginSection("ghosts");
  visitor.Visit({"tolerance_px", "px", 0, 10,
                 "A point within this distance of a colour edge lies on it; covers blur and "
                 "colour-to-depth registration."},
                options.edge_tolerance_px);
  VisitOptions(options.ghosts, visitor);
}

SegmentationModel LearnSegmentation(const Sequence& sequence, const TsdfVolume& volume,
                                    const SegmentationOptions& options) {
  SegmentationModel model;
  if (options.min_measured_share > 0) {
    model.is_background_measured =
        MeasuredShare(sequence, ThinnedTo(AllFrames(sequence), kBackgroundFrames)) >=
        options.min_measured_share;
  }
  model.openness = MeasureOpenness(sequence, volume, options.openness_stride);
  if (options.gate.frames == 0) return model;
  const LearnedFrames learned =
      Render(sequence, ThinnedTo(AllFrames(sequence), options.gate.frames), volume, options);
  if (options.max_array_spacing > 0) model.sheets = FindSheets(sequence, learned, options);
  std::vector<WireCandidates> candidates = CandidatesOf(sequence, learned, volume, model, options);
  if (options.max_array_spacing > 0) {
    if (LearnWireArrays(sequence, options, candidates, model)) return model;
    SetArrayMargin(WireCandidates().array_margin, candidates);
  }
  if (!model.sheets.empty()) {
    model.sheets = {};
    candidates = CandidatesOf(sequence, learned, volume, model, options);
  }
  model.colours = LearnWireColours(candidates, sequence, options.gate);
  if (options.max_array_spacing > 0) model.nets = FindNets(sequence);
  if (options.max_frame_points > 0 && IsVideo(sequence) &&
      PointsPerFrame(sequence, model.colours, options, candidates) > options.max_frame_points) {
    model.frame_stride = kCrowdedStride;
  }
  return model;
}

SegmentedBundle SegmentBundle(const Sequence& sequence, int first, int last,
                              const TsdfVolume& volume, const SegmentationModel& model,
                              const SegmentationOptions& options,
                              const std::function<void()>& on_frame) {
  SegmentedBundle segmented;
  segmented.T_world_bundle = sequence.frames[first].T_world_camera;
  // A point is seen in so many times fewer frames.
  BundleOptions bundle = options.bundle;
  bundle.min_frames = (bundle.min_frames + model.frame_stride - 1) / model.frame_stride;
  BundleDifferenceSet difference_set(bundle);
  std::vector<int> frames;
  for (int frame = first; frame < last; frame += model.frame_stride) frames.push_back(frame);
  std::vector<SegmentedFrame> window(kFramesAtOnce);
  for (size_t start = 0; start < frames.size(); start += kFramesAtOnce) {
    const std::span at_once =
        std::span(frames).subspan(start, std::min(kFramesAtOnce, frames.size() - start));
    ParallelFor(0, static_cast<int64_t>(at_once.size()), 1, [&](int64_t i) {
      window[i] = SegmentFrame(sequence, at_once[i], volume, model, options);
      on_frame();
    });
    for (size_t i = 0; i < at_once.size(); ++i) {
      const auto& [candidates, on_edge, funnel] = window[i];
      segmented.funnel.Add(funnel);
      difference_set.AddFrame(
          candidates.mask, on_edge, candidates.depth, sequence.depth_camera,
          segmented.T_world_bundle.inverse() * sequence.frames[at_once[i]].T_world_camera);
    }
  }
  AddNetWires(sequence, first, last, model.nets, segmented.T_world_bundle.inverse(), difference_set,
              frames);
  BundlePoints candidates = difference_set.Points();
  PointFunnel& funnel = segmented.funnel;
  funnel.merged_points = static_cast<int64_t>(difference_set.voxel_count());
  funnel.too_few_frames = funnel.merged_points - static_cast<int64_t>(candidates.points.size());
  BundlePoints remaining = RemoveGhosts(candidates, options.ghosts, &funnel);
  funnel.points = static_cast<int64_t>(remaining.points.size());
  std::vector<ObservedPoints> seen = difference_set.FramePoints(remaining.voxels);
  segmented.frames.resize(last - first);
  for (size_t i = 0; i < frames.size(); ++i) {
    ObservedPoints& points = segmented.frames[frames[i] - first];
    if (points.empty())
      points = std::move(seen[i]);
    else
      Append(points, seen[i]);
  }
  segmented.difference_set = std::move(candidates.points);
  segmented.points = std::move(remaining.points);
  return segmented;
}

}  // namespace curvefusion
