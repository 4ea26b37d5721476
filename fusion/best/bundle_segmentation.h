#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "capture/sequence.h"
#include "fusion/best/best_options.h"
#include "fusion/funnel.h"
#include "fusion/registration/frame_points.h"
#include "fusion/segmentation/segmentation.h"
#include "fusion/stage_progress.h"
#include "fusion/volume/tsdf_volume.h"

namespace curvefusion {

// The first half of the best profile finds what is thin in bundles of frames, the second half makes
// curves of it. What goes from one to the other passes through a BundleSink, so that the halves may
// run in different processes (fusion/shards).

/// What reports tell of the volume of all frames.
struct VolumeFigures {
  int64_t frames = 0;  ///< that were integrated
  int64_t blocks = 0;
  int64_t bytes = 0;
};

/// What segmentation has learned of wires (SegmentationModel) that later stages use, too.
struct LearnedWires {
  int frame_stride = 1;       ///< every so many-th frame is segmented
  double array_spacing = 0;   ///< of the wires of wire arrays, metres; 0 where there are none
  double array_diameter = 0;  ///< of their wires, metres, roughly
  WireColours colours;
  Nets nets;
};

/// What has been learned of all frames: the same, whichever bundles are segmented.
struct LearnedScan {
  VolumeFigures volume;
  LearnedWires wires;
};

/// Bundles [first, last) of a sequence (SplitIntoBundles).
struct BundleRange {
  int first = 0;
  int last = 0;
};

/// Takes what the first half finds.
struct BundleSink {
  std::function<void(const LearnedScan&)> on_learned;     ///< once, before any bundle
  std::function<void(const SegmentedBundle&)> on_bundle;  ///< in the order of the sequence
};

/// Where the second half has its bundles from: fills a sink.
using BundleSource = std::function<void(const BundleSink&)>;

/// All bundles of a sequence.
BundleRange AllBundles(const Sequence& sequence, const BestOptions& options);

/// "Removing large surfaces" needs a model of them: all frames in one volume. The observer is given
/// it.
TsdfVolume FuseVolumeOfRun(const Sequence& sequence, const BestOptions& options,
                           const StageReporter& reporter);

/// Learns what segmentation needs from frames of the whole sequence, and segments these bundles.
/// Throws Error(kBadInput) for an image that cannot be read; exceptions of the sink pass through.
void SegmentBundles(const Sequence& sequence, const TsdfVolume& volume, BundleRange range,
                    const BestOptions& options, const StageReporter& reporter,
                    const BundleSink& sink);

/// What was found thin in all bundles, in the world frame.
struct SegmentedScan {
  // Chosen to bound memory: what frames saw takes up to 110 MB, all points of the first 100 to 400
  // frames.
  static constexpr size_t kMaxFramePoints = 2'000'000;

  LearnedWires wires;
  std::vector<ObservedPoints> bundles;
  FramePoints frames{kMaxFramePoints};  ///< what each frame saw of its bundle's points
  std::vector<int> bundle_of_frame;
  double candidates = 0;  ///< of all bundles, before ghosts were removed
  double points = 0;      ///< of all bundles
  PointFunnel funnel;
};

/// Gathers all bundles of a source; the observer is given their points, and the plan of the run as
/// they become known.
SegmentedScan GatherBundles(const BundleSource& source, const Sequence& sequence,
                            const BestOptions& options, const StageReporter& reporter);

}  // namespace curvefusion
