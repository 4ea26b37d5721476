#pragma once

#include "capture/sequence.h"
#include "fusion/best/best_options.h"
#include "fusion/live/live_snapshot.h"
#include "fusion/segmentation/segmentation.h"
#include "fusion/volume/tsdf_volume.h"

namespace curvefusion {

/// Processor seconds so far, of all threads, by what took them.
struct LiveCost {
  double volume = 0;  ///< reading depth and integrating it
  double learning = 0;
  double segmentation = 0;
  double registration = 0;  ///< of bundles, with their ridges and sightings
  double snapshots = 0;
};

/// The curves of a scan while it is being made: the best profile up to its first contraction, frame
/// by frame. Memory and work of a frame depend on what was scanned, not on for how long. Against
/// the batch, which has all frames from the start, every bundle is segmented against the volume of
/// the frames so far, colours are learned from those, every second frame is looked at, and neither
/// diameters are measured nor curves adjusted to colour images. The same frames give the same
/// snapshots for any number of threads.
class LiveReconstruction {
 public:
  /// `cameras` is a sequence without frames: its cameras and depth scale.
  LiveReconstruction(const Sequence& cameras, const BestOptions& options);

  /// Takes the next frame, whose pose is known. Returns whether it was the last of a bundle, so
  /// that the evidence has changed. Throws Error(kBadInput) for an image that cannot be read.
  bool AddFrame(const SequenceFrame& frame);

  /// All that was found so far.
  const LiveEvidence& evidence() const { return evidence_; }

  /// Some of all frames, evenly spread: at most 64.
  const Sequence& sample() const { return sample_; }

  LiveSnapshot Snapshot();

  size_t volume_bytes() const { return volume_.memory_bytes(); }
  const LiveCost& cost() const { return cost_; }

 private:
  void IntegrateLatest();
  void AddToSample(const SequenceFrame& frame);
  void LearnIfDue();
  SegmentedBundle SegmentFrames();
  void Register(const SegmentedBundle& bundle);

  BestOptions options_;
  TsdfVolume volume_;
  int frame_count_ = 0;
  Sequence bundle_;        ///< the frames of the bundle that has not ended
  Sequence sample_;        ///< what colours and grilles are learned from
  int sample_stride_ = 1;  ///< every so many-th frame is one of it
  SegmentationModel model_;
  int learn_at_ = 0;           ///< frames: the model is learned again once there are so many
  size_t largest_bundle_ = 0;  ///< points
  LiveEvidence evidence_;
  LiveCost cost_;
};

}  // namespace curvefusion
