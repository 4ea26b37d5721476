#include "fusion/best/best_plan.h"

#include <algorithm>

namespace curvefusion {

namespace {

// Until something was found: points a frame and metres of curve, between those of the real and the
// simulated scans of docs/results_details.md#time-left.
constexpr double kPointsPerFrame = 500;
constexpr double kLength = 3;
// The image size that costs were measured at.
constexpr double kPixels = 640 * 480;
// Points that a metre of wire has where every view shows it, in the same scans: 35,000 to 50,000.
constexpr double kPointsPerMetre = 35000;

// What a run consists of, in the units that costs depend on.
struct Amounts {
  double size;        // of images, in kPixels
  double integrated;  // frames of the volume
  double frames;      // segmented
  double learned;     // frames that surfaces and colours are learned from
  double points;      // in 100,000
  double seen;        // metres of wire that images show
  double length;      // metres of curve
  double strips;      // colour images that radii are measured in
  double adjusted;    // colour images that curves are adjusted to
  double looked;      // depth images that evidence is looked for in
};

Amounts AmountsOf(const Sequence& sequence, const BestOptions& options, const RunSize& size) {
  // Of the colour adjustment: the rest is thinned.
  constexpr double kMaxAdjusted = 120;
  const double frames = sequence.frame_count();
  const double points = size.points > 0 ? size.points : kPointsPerFrame * frames;
  const int stride = IsVideo(sequence) ? options.colour_adjustment.frame_stride : 1;
  const PinholeCamera& depth = sequence.depth_camera;
  return {.size = static_cast<double>(depth.width) * depth.height / kPixels,
          .integrated = frames / options.volume_stride,
          .frames = frames,
          .learned = std::min<double>(frames, options.segmentation.gate.frames),
          .points = points / 1e5,
          .seen = points / kPointsPerMetre,
          .length = size.length > 0 ? size.length : kLength,
          .strips = std::min<double>(frames, options.radius.max_frames),
          .adjusted = std::min(frames / stride, kMaxAdjusted),
          .looked = std::min<double>(frames, options.evidence.max_frames)};
}

// Seconds of one thread: up to the contraction fitted to cubeframe, lampshade, cable, kitchen and
// aims, what follows to cage, chair, umbrella, basket, cubeframe and lampshade
// (docs/results_details.md#time-left). Every stage that may run stands here, radii after a curve
// was left out among them: one that is not run is passed over, but one that is not here would be
// taken for a later stage of its name.
std::vector<PlannedStage> BestStages(const Amounts& a) {
  const double radius = a.strips * (0.0033 * a.size + 0.0016 * a.seen);
  const double evidence = a.looked * (0.0045 * a.size + 0.0002 * a.seen);
  return {{"volume", 0.0125 * a.integrated},
          {"surfaces and colours", 0.11 * a.size * a.learned},
          {"segmentation", 0.037 * a.size * a.frames + a.points},
          {"bundle registration", 0.1 + 0.45 * a.points},
          {"contraction", 0.1},
          {"radius", radius},
          {"frame registration", 0.05 + 1.0 * a.points},
          {"contraction", 0.05 + 0.4 * a.points},
          {"radius", radius},
          {"evidence", evidence},
          {"radius", 0},
          {"colour adjustment", a.adjusted * (0.03 * a.size + 0.006 * a.seen)},
          {"strips", 0.042 * a.size * a.adjusted},
          {"silhouettes", 0.003 * a.size * a.adjusted * a.length},
          {"radius", radius},
          {"evidence", evidence},
          {"radius", 0},
          {"wires from colour", std::min(a.adjusted, 90.0) * (0.01 * a.size + 0.009 * a.seen)},
          {"radius", radius},
          {"evidence", evidence}};
}

}  // namespace

std::vector<PlannedStage> PlanBest(const Sequence& sequence, const BestOptions& options,
                                   const RunSize& size) {
  return BestStages(AmountsOf(sequence, options, size));
}

}  // namespace curvefusion
