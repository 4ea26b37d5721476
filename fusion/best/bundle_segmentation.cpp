#include "fusion/best/bundle_segmentation.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "fusion/best/best_plan.h"
#include "fusion/stage_progress.h"
#include "fusion/volume/volume_fusion.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Chosen: bundles segmented at the same time, at most. Much of a bundle is done one step after the
// other.
constexpr size_t kBundlesAtOnce = 4;

using FrameRanges = std::vector<std::pair<int, int>>;

int64_t FramesToSegment(const FrameRanges& ranges, int frame_stride) {
  int64_t frames = 0;
  for (const auto& [first, last] : ranges)
    frames += (last - first + frame_stride - 1) / frame_stride;
  return frames;
}

SegmentationModel LearnSegmentationOfRun(const Sequence& sequence, const TsdfVolume& volume,
                                         const SegmentationOptions& options,
                                         const StageReporter& reporter) {
  const StageLog::Timer timer(reporter.log, "segmentation");
  reporter.observer.OnProgress("surfaces and colours", 0, 1);
  return LearnSegmentation(sequence, volume, options);
}

int64_t FramesInVolume(const Sequence& sequence, const BestOptions& options) {
  return (sequence.frame_count() + options.volume_stride - 1) / options.volume_stride;
}

VolumeFigures FiguresOf(const TsdfVolume& volume, int64_t frames) {
  return {frames, static_cast<int64_t>(volume.block_count()),
          static_cast<int64_t>(volume.memory_bytes())};
}

FrameRanges FramesOf(const Sequence& sequence, BundleRange range, const BestOptions& options) {
  const FrameRanges all =
      SplitIntoBundles(sequence.frame_count(), options.segmentation.bundle.frames);
  return {all.begin() + range.first, all.begin() + range.last};
}

void AddBundle(const SegmentedBundle& bundle, SegmentedScan& scan, PipelineObserver& observer) {
  const std::string name = fmt::format("bundle_{:03}", scan.bundles.size());
  observer.OnPoints(name + "_difference_set",
                    Transformed(bundle.difference_set, bundle.T_world_bundle));
  for (const ObservedPoints& frame : bundle.frames) {
    scan.frames.Add(Transformed(frame, bundle.T_world_bundle));
    scan.bundle_of_frame.push_back(static_cast<int>(scan.bundles.size()));
  }
  scan.candidates += static_cast<double>(bundle.difference_set.size());
  scan.points += static_cast<double>(bundle.points.size());
  scan.funnel.Add(bundle.funnel);
  scan.bundles.push_back(Transformed(bundle.points, bundle.T_world_bundle));
  observer.OnPoints(name + "_points", scan.bundles.back());
}

}  // namespace

BundleRange AllBundles(const Sequence& sequence, const BestOptions& options) {
  return {0,
          static_cast<int>(
              SplitIntoBundles(sequence.frame_count(), options.segmentation.bundle.frames).size())};
}

TsdfVolume FuseVolumeOfRun(const Sequence& sequence, const BestOptions& options,
                           const StageReporter& reporter) {
  const StageLog::Timer timer(reporter.log, "volume");
  StageProgress progress(reporter.observer, "volume", FramesInVolume(sequence, options));
  TsdfVolume volume = FuseVolume(sequence, options.volume, options.volume_stride,
                                 [&progress] { progress.Advance(); });
  reporter.observer.OnVolume(volume);
  return volume;
}

void SegmentBundles(const Sequence& sequence, const TsdfVolume& volume, BundleRange range,
                    const BestOptions& options, const StageReporter& reporter,
                    const BundleSink& sink) {
  const SegmentationModel model =
      LearnSegmentationOfRun(sequence, volume, options.segmentation, reporter);
  sink.on_learned(
      {FiguresOf(volume, FramesInVolume(sequence, options)),
       {model.frame_stride, model.array_spacing, model.array_diameter, model.colours, model.nets}});
  const StageLog::Timer timer(reporter.log, "segmentation");
  const FrameRanges ranges = FramesOf(sequence, range, options);
  StageProgress progress(reporter.observer, "segmentation",
                         FramesToSegment(ranges, model.frame_stride));
  // About as many each time, so that no bundle is left to itself in the end.
  const size_t times = (ranges.size() + kBundlesAtOnce - 1) / kBundlesAtOnce;
  size_t begin = 0;
  for (size_t left = times; left > 0; --left) {
    std::vector<SegmentedBundle> bundles((ranges.size() - begin + left - 1) / left);
    ParallelFor(0, static_cast<int64_t>(bundles.size()), 1, [&](int64_t i) {
      const auto& [first, last] = ranges[begin + static_cast<size_t>(i)];
      bundles[i] = SegmentBundle(sequence, first, last, volume, model, options.segmentation,
                                 [&progress] { progress.Advance(); });
    });
    for (const SegmentedBundle& bundle : bundles) sink.on_bundle(bundle);
    begin += bundles.size();
  }
}

SegmentedScan GatherBundles(const BundleSource& source, const Sequence& sequence,
                            const BestOptions& options, const StageReporter& reporter) {
  SegmentedScan scan;
  const auto count = [&](const char* what, double value) {
    reporter.log.Count("segmentation", what, value);
  };
  source({[&](const LearnedScan& learned) {
            scan.wires = learned.wires;
            count("spacing in wire arrays, mm", scan.wires.array_spacing / kMillimetre);
            count("cells of nets", static_cast<double>(scan.wires.nets.cells.size()));
            count("spacing in nets, mm", scan.wires.nets.spacing / kMillimetre);
            count("frame stride", scan.wires.frame_stride);
          },
          [&](const SegmentedBundle& bundle) {
            AddBundle(bundle, scan, reporter.observer);
            // As if the rest held as many.
            const auto frames = static_cast<double>(scan.bundle_of_frame.size());
            const double points = scan.points * sequence.frame_count() / frames;
            reporter.observer.OnPlan(PlanBest(sequence, options, {.points = points}));
          }});
  count("bundles", static_cast<double>(scan.bundles.size()));
  count("candidates", scan.candidates);
  count("points", scan.points);
  count("frame point stride", static_cast<double>(scan.frames.stride()));
  return scan;
}

}  // namespace curvefusion
