#include "fusion/live/live_reconstruction.h"

#include <ctime>
#include <utility>

#include "fusion/registration/ray_noise.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Chosen: of a bundle's frames every second is segmented, as neighbours see the same.
constexpr int kFrameStride = 2;
// Frames that colours and grilles are learned from, at most. Chosen: some ten are asked for
// each, and half of them are left when they are thinned.
constexpr size_t kSample = 64;

// Processor seconds of this process so far, of all its threads.
double ProcessorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// Adds the processor time until its end of life, of all threads, to a sum.
class ProcessorTimer {
 public:
  explicit ProcessorTimer(double& seconds) : seconds_(seconds) {}
  ~ProcessorTimer() { seconds_ += ProcessorSeconds() - start_; }
  ProcessorTimer(const ProcessorTimer&) = delete;
  ProcessorTimer& operator=(const ProcessorTimer&) = delete;

 private:
  double& seconds_;
  double start_ = ProcessorSeconds();
};

BestOptions ForLive(BestOptions options) {
  // Arrays of close wires take a model of all frames; the batch resolves them.
  options.segmentation.max_array_spacing = 0;
  options.segmentation.max_frame_points = 0;  // decides on the stride, which is fixed here
  return options;
}

// Nothing of its images is kept either.
Sequence WithoutFrames(Sequence sequence) {
  sequence.frames.clear();
  sequence.decoded.reset();
  return sequence;
}

}  // namespace

LiveReconstruction::LiveReconstruction(const Sequence& cameras, const BestOptions& options)
    : options_(ForLive(options)),
      volume_(options.volume),
      bundle_(KeepingImages(WithoutFrames(cameras))),
      sample_(WithoutFrames(cameras)),
      evidence_{CarriedPoints(options.carried), {}} {}

bool LiveReconstruction::AddFrame(const SequenceFrame& frame) {
  bundle_.frames.push_back(frame);
  IntegrateLatest();
  AddToSample(frame);
  ++frame_count_;
  if (bundle_.frame_count() < options_.segmentation.bundle.frames) return false;
  LearnIfDue();
  Register(SegmentFrames());
  return true;
}

LiveSnapshot LiveReconstruction::Snapshot() {
  const ProcessorTimer timer(cost_.snapshots);
  return MakeSnapshot(evidence_, options_);
}

void LiveReconstruction::IntegrateLatest() {
  if (frame_count_ % options_.volume_stride != 0) return;
  const ProcessorTimer timer(cost_.volume);
  const int latest = bundle_.frame_count() - 1;
  DepthImage depth;
  // The colour image is kept for the segmentation, which as a rule looks at the same frames.
  const int images = latest % kFrameStride == 0 ? 2 : 1;
  ParallelFor(0, images, 1, [&](int64_t i) {
    if (i == 0) depth = LoadDepth(bundle_, latest);
    if (i == 1) LoadColor(bundle_, latest);
  });
  volume_.Integrate(depth, bundle_.depth_camera, bundle_.frames.back().T_world_camera);
}

// Once there are too many, every second one is forgotten.
void LiveReconstruction::AddToSample(const SequenceFrame& frame) {
  if (frame_count_ % sample_stride_ != 0) return;
  std::vector<SequenceFrame>& frames = sample_.frames;
  frames.push_back(frame);
  if (frames.size() <= kSample) return;
  std::vector<SequenceFrame> kept;
  for (size_t i = 0; i < frames.size(); i += 2) kept.push_back(std::move(frames[i]));
  frames = std::move(kept);
  sample_stride_ *= 2;
}

// Each time the frames have trebled: the work of one frame falls.
void LiveReconstruction::LearnIfDue() {
  if (frame_count_ < learn_at_) return;
  const ProcessorTimer timer(cost_.learning);
  sample_.color_levels = bundle_.color_levels = MeasureColorLevels(sample_);
  model_ = LearnSegmentation(sample_, volume_, options_.segmentation);
  model_.frame_stride = kFrameStride;
  learn_at_ = 3 * frame_count_;
}

SegmentedBundle LiveReconstruction::SegmentFrames() {
  const ProcessorTimer timer(cost_.segmentation);
  SegmentedBundle segmented = SegmentBundle(bundle_, 0, bundle_.frame_count(), volume_, model_,
                                            options_.segmentation, [] {});
  bundle_ = KeepingImages(WithoutFrames(std::move(bundle_)));
  return segmented;
}

void LiveReconstruction::Register(const SegmentedBundle& bundle) {
  const ProcessorTimer timer(cost_.registration);
  const ObservedPoints points = Transformed(bundle.points, bundle.T_world_bundle);
  const RidgeProjectionOptions& ridges = options_.ridge.projection;
  const RidgePoints found = ProjectToRidges(points, ForBundles(ridges));
  const RigidTransform T_registered_world =
      evidence_.carried.AddBundle(points, found, ridges.spacing, options_.registration)
          .T_target_source;
  for (const ObservedPoints& frame : bundle.frames) {
    if (frame.empty()) continue;
    evidence_.sightings.AddFrame(Transformed(frame, T_registered_world * bundle.T_world_bundle));
  }
  if (points.size() > largest_bundle_) {
    largest_bundle_ = points.size();
    evidence_.ray_noise_ratio = RayNoiseRatio(points, options_.min_linearity);
  }
}

}  // namespace curvefusion
