#include "fusion/best/colour_curves.h"

#include <optional>
#include <utility>
#include <vector>

#include "capture/frame_stream.h"
#include "capture/image_mat.h"
#include "fusion/appearance/local_contrast.h"
#include "fusion/best/colour_fit.h"
#include "fusion/best/curves_in_depth.h"
#include "fusion/curve_graph/candidate_proof.h"
#include "fusion/curve_graph/colour_candidates.h"
#include "fusion/curve_graph/strip_snapping.h"
#include "graph/contraction/ridge_skeleton.h"

namespace curvefusion {

namespace {

// Chosen: the second round has the poses of the first.
constexpr int kRounds = 2;
// Derived: pixels of the images that StripViews looks at; its strips differ from what is 8 pixels
// to both sides.
constexpr double kWidestStripPx = 12;
// Chosen. Without depth, poses are those of the input until curves were adjusted: in images of half
// the size they are off by half as many pixels.
constexpr double kFirstScale = 0.5;
// Derived: twice the reach of a strip. Short paths know no better how far a place is.
constexpr double kSamePlacePx = 3;
// Chosen on 13 training scans by Azure Kinect and Kinect V2. Of places that half of the images have
// too .47 to 1.00 lie on wires, of those that fewer have .03 to .22 (two of the scans,
// docs/lab_notebook.md).
constexpr double kMinSupport = 0.5;
constexpr double kUsualRadius = 0.0025;  // chosen: metres, where no image shows how thick wires are

// How a round looks at images.
struct Look {
  double scale = 1;
  CandidateOptions candidates;
};

Look LookOf(int round, bool has_depth, WireDepth depth, bool in_thin_pixels, size_t max_rays) {
  if (in_thin_pixels) {
    return {1,
            {.places = CandidatePlaces::kFree, .max_rays = max_rays, .min_support = kMinSupport}};
  }
  if (has_depth) {
    return {1,
            {.places = CandidatePlaces::kFree,
             .follow = depth == WireDepth::kLookedPast,
             .max_rays = max_rays}};
  }
  return {round == 0 ? kFirstScale : 1, {.same_place_px = kSamePlacePx}};
}

// The places that images agree on, contracted.
void ContractPlaces(const StripViews& views, const CandidateOptions& candidates,
                    const BestOptions& options, const StageReporter& reporter,
                    Reconstruction& colour) {
  colour.points = FindColourCandidates(views, candidates, [&](int64_t done, int64_t total) {
    reporter.observer.OnProgress(kWiresFromColour, done, total);
  });
  colour.skeleton = ExtractRidgeSkeleton(colour.points, options.ridge);
  reporter.log.Count(kWiresFromColour, "places", static_cast<double>(colour.points.size()));
  reporter.log.Count(kWiresFromColour, "length, m", colour.skeleton.TotalLength());
  reporter.observer.OnPoints("colour_places", colour.points);
  reporter.observer.OnGraph("from_colour", colour.skeleton);
}

// Leaves of the curves what strips prove.
void KeepProven(StripViews& views, const StageReporter& reporter, Reconstruction& colour) {
  const StageLog::Timer timer = reporter.Begin(kWiresFromColour);
  const double measured = colour.radii.unmeasured_radius;
  KeepProvenCandidates(colour.sequence, {}, colour.points.positions,
                       measured > 0 ? measured : kUsualRadius, views, colour.skeleton);
  reporter.log.Count(kWiresFromColour, "proven length, m", colour.skeleton.TotalLength());
}

// Curves of known radius that images agree on.
void FindCurves(const WireImages& images, const Eigen::AlignedBox3d& around,
                const Reconstruction* thin, const Look& look, const BestOptions& options,
                const StageReporter& reporter, Reconstruction& colour) {
  std::optional<StripViews> views;
  {
    const StageLog::Timer timer = reporter.Begin(kWiresFromColour);
    std::vector<PosteriorImage> kept;
    if (thin != nullptr) kept = KeepThinInDepth(*thin, images.frames, images.posteriors);
    views.emplace(colour.sequence, images.frames, thin != nullptr ? kept : images.posteriors,
                  around, look.scale);
    ContractPlaces(*views, look.candidates, options, reporter, colour);
    if (thin != nullptr) SnapToStrips(*views, colour.skeleton);
  }
  if (colour.skeleton.empty()) return;
  AssignMeasuredRadii(0, options.radius, reporter, colour);
  if (thin == nullptr) return;
  KeepProven(*views, reporter, colour);
  AssignMeasuredRadii(0, options.radius, reporter, colour);
}

}  // namespace

WireImages LookForColours(const Sequence& sequence, const WireColours& colours) {
  WireImages images{EvenlyThinned(AllFrames(sequence), kColourImages), {}};
  ForEachFrame(
      sequence, images.frames, {.depth = false, .color = true}, [&](const DecodedFrame& frame) {
        images.posteriors.push_back(ApplyPosterior(BinColours(frame.color), colours.posterior));
      });
  return images;
}

WireImages LookForContrast(const Sequence& sequence) {
  WireImages images{EvenlyThinned(AllFrames(sequence), kColourImages), {}};
  const PinholeCamera camera = StripViews::CameraLookedThrough(sequence.color_camera, kFirstScale);
  ForEachFrame(
      sequence, images.frames, {.depth = false, .color = true}, [&](const DecodedFrame& frame) {
        images.posteriors.push_back(
            LocalContrast(ShrunkTo(camera.width, camera.height, frame.color), kWidestStripPx));
      });
  return images;
}

std::optional<ColourCurves> FitCurvesOfColour(
    const Sequence& sequence, const AdjustmentStart& start, Eigen::AlignedBox3d around,
    const Reconstruction* thin, const BestOptions& options, const StageReporter& reporter,
    WireImages& images, Reconstruction& colour) {
  colour.sequence = sequence;
  Reconstruction next;
  const auto find_adjusted = [&](int round, size_t max_rays) {
    next = {};
    next.sequence = colour.sequence;
    FindCurves(images, around, thin,
               LookOf(round, sequence.has_depth, start.depth, thin != nullptr, max_rays), options,
               reporter, next);
    return AdjustCurvesAndPoses(start, options.colour_adjustment, reporter, next);
  };
  size_t max_rays = thin != nullptr ? kManyRays : CandidateOptions().max_rays;
  std::optional<ColourCurves> fitted;
  for (int round = 0; round < kRounds; ++round) {
    std::optional<ColourAdjustment> again = find_adjusted(round, max_rays);
    // Of thin wires and rough poses few lines of sight find a place.
    if (!again && round == 0 && sequence.has_depth && start.depth == WireDepth::kNotShown &&
        max_rays < kManyRays) {
      max_rays = kManyRays;
      again = find_adjusted(round, max_rays);
    }
    if (!again) break;
    // As exact already.
    if (round > 0 && sequence.has_depth && !CameNearer(*again)) break;
    images = {again->frames, again->posteriors};
    fitted = {std::move(*again), start};
    colour = std::move(next);
    if (!sequence.has_depth) around = BoundsOf(colour.skeleton);
  }
  return fitted;
}

}  // namespace curvefusion
