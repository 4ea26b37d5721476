#include "fusion/segmentation/colour_gate.h"

#include <Eigen/Dense>
#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "capture/image_mat.h"
#include "fusion/appearance/wire_posterior.h"
#include "fusion/segmentation/colour_lookup.h"
#include "fusion/segmentation/stripe_field.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Chosen: background is learned this far from masks, beyond block matching's fattening and blur,
// near enough to be what also shows through gaps.
constexpr int kFromMask_px = 5;
constexpr int kToMask_px = 20;
// Chosen: colour and depth images of one device are registered to within so many pixels.
constexpr int kMaxShift_px = 3;
// Chosen. The paraboloid through the scores overshoots a top off the middle; each round brings it
// nearer.
constexpr int kShiftRounds = 4;
// Chosen: the likeliest pixel is looked for within so many.
constexpr int kPeakReach_px = 2;
// Pixels less likely to be wire are dropped. Chosen below one half, so that nothing goes where
// wires and background look the same.
constexpr double kMinPosterior = 0.4;
// Chosen: nor are those kept that are less likely than so much of the likeliest one around: blur
// raises narrow gaps.
constexpr double kMinOfPeak = 0.6;
// Chosen, of 255: surely wire, as no background that was seen has that colour.
constexpr int kSurePosterior = 200;
// Chosen. Colours that blur mixes of wire and background are of neither in the end: each round
// takes the half that lies in valleys for background.
constexpr int kSharpeningRounds = 4;

// The greatest value within a square around each pixel.
Image<uint8_t> Dilated(const Image<uint8_t>& image, int radius) {
  Image<uint8_t> dilated(image.width(), image.height());
  cv::dilate(MatOf(image), MatOf(dilated), cv::Mat::ones(2 * radius + 1, 2 * radius + 1, CV_8U));
  return dilated;
}

void Learn(const WireCandidates& frame, const MaskImage& wire, const MaskImage& background,
           const ColourLookup& lookup, WireColourModel& model) {
  const ColourBins bins = BinColours(frame.color);
  ForEachColour(wire, frame.depth, lookup,
                [&](int, int, int x, int y) { model.AddWire(bins(x, y)); });
  ForEachColour(background, frame.depth, lookup,
                [&](int, int, int x, int y) { model.AddBackground(bins(x, y)); });
}

// What learn(i, model) tells of each of so many frames, together.
template <class LearnFrame>
WireColourModel LearnAll(size_t frames, const LearnFrame& learn) {
  std::vector<WireColourModel> models(frames);
  ParallelFor(0, static_cast<int64_t>(frames), 1, [&](int64_t i) { learn(i, models[i]); });
  WireColourModel all;
  for (const WireColourModel& model : models) all.Add(model);
  return all;
}

MaskImage BackgroundAround(const MaskImage& mask) {
  const MaskImage near = Dilated(mask, kFromMask_px);
  MaskImage around = Dilated(mask, kToMask_px);
  for (size_t i = 0; i < around.size(); ++i) around.data()[i] &= !near.data()[i];
  return around;
}

// How likely the masks' pixels are wire when they are seen so far off, for each shift.
using ShiftScores = Eigen::Matrix<double, 2 * kMaxShift_px + 1, 2 * kMaxShift_px + 1>;

void AddScores(const WireCandidates& frame, const PosteriorImage& posterior,
               const ColourLookup& lookup, ShiftScores& scores) {
  ForEachColour(frame.mask, frame.depth, lookup, [&](int, int, int x, int y) {
    for (int dy = -kMaxShift_px; dy <= kMaxShift_px; ++dy) {
      for (int dx = -kMaxShift_px; dx <= kMaxShift_px; ++dx) {
        if (!posterior.Contains(x + dx, y + dy)) continue;
        scores(dy + kMaxShift_px, dx + kMaxShift_px) += posterior(x + dx, y + dy);
      }
    }
  });
}

// The top of the paraboloid through the scores; they have a flat top where masks are fat. Zero
// where they have no top.
Vec2 BestShift(const ShiftScores& scores) {
  constexpr int kSide = 2 * kMaxShift_px + 1;
  Eigen::Matrix<double, kSide * kSide, 6> terms;
  Eigen::Matrix<double, kSide * kSide, 1> values;
  for (int i = 0; i < kSide * kSide; ++i) {
    const double x = i % kSide - kMaxShift_px, y = i / kSide - kMaxShift_px;
    terms.row(i) << 1, x, y, x * x, x * y, y * y;
    values(i) = scores(i / kSide, i % kSide);
  }
  const Eigen::Matrix<double, 6, 1> c = terms.colPivHouseholderQr().solve(values);
  Eigen::Matrix2d curvature;
  curvature << 2 * c(3), c(4), c(4), 2 * c(5);
  if (!(curvature(0, 0) < 0) || !(curvature.determinant() > 0)) return Vec2::Zero();
  return -curvature.inverse() * Vec2(c(1), c(2));
}

// Where the masks' pixels are likeliest wire; zero where that is nowhere within reach.
Vec2 FindShift(const std::vector<WireCandidates>& frames, const std::vector<uint8_t>& posterior,
               const Sequence& sequence) {
  const auto n = static_cast<int64_t>(frames.size());
  std::vector<PosteriorImage> images(frames.size());
  ParallelFor(0, n, 1, [&](int64_t i) {
    images[i] = ApplyPosterior(BinColours(frames[i].color), posterior);
  });
  Vec2 shift = Vec2::Zero();
  for (int round = 0; round < kShiftRounds; ++round) {
    std::vector<ShiftScores> of_frame(frames.size(), ShiftScores::Zero());
    const ColourLookup lookup(sequence, shift);
    ParallelFor(0, n, 1, [&](int64_t i) { AddScores(frames[i], images[i], lookup, of_frame[i]); });
    ShiftScores scores = ShiftScores::Zero();
    for (const ShiftScores& some : of_frame) scores += some;
    shift += BestShift(scores);
    if (!(shift.cwiseAbs().maxCoeff() <= kMaxShift_px)) return Vec2::Zero();
  }
  return shift;
}

// Euclidean distances in pixels to the nearest pixel that is 0.
Image<float> DistanceToZero(const MaskImage& mask) {
  Image<float> distance(mask.width(), mask.height());
  cv::distanceTransform(MatOf(mask), MatOf(distance), cv::DIST_L2, cv::DIST_MASK_5);
  return distance;
}

// The pixels of a colour image that are surely wire by their colours and not background by depth.
MaskImage SureWire(const PosteriorImage& posterior, const WireCandidates& frame,
                   const ColourLookup& lookup) {
  MaskImage sure(posterior.width(), posterior.height());
  for (size_t i = 0; i < sure.size(); ++i) sure.data()[i] = posterior.data()[i] >= kSurePosterior;
  MaskImage others = frame.mask;
  for (size_t i = 0; i < others.size(); ++i) others.data()[i] ^= 1;
  ForEachColour(others, frame.depth, lookup, [&](int, int, int x, int y) { sure(x, y) = 0; });
  return sure;
}

// Takes from the mask what lies in a disc of surely wire-coloured pixels wider than any wire.
void DropUnresolved(const PosteriorImage& posterior, const ColourLookup& lookup, double focal_px,
                    double max_width, const MaskImage& in_arrays, WireCandidates& frame) {
  const MaskImage sure = SureWire(posterior, frame, lookup);
  const Image<float> depth_in = DistanceToZero(sure);
  const auto radius_px = [&](float depth) { return 0.5 * max_width * focal_px / depth; };
  MaskImage outside_core(sure.width(), sure.height(), 1);
  bool has_core = false;
  ForEachColour(in_arrays, frame.depth, lookup, [&](int u, int v, int x, int y) {
    if (depth_in(x, y) < radius_px(frame.depth(u, v))) return;
    outside_core(x, y) = 0;
    has_core = true;
  });
  if (!has_core) return;
  const Image<float> to_core = DistanceToZero(outside_core);
  ForEachColour(in_arrays, frame.depth, lookup, [&](int u, int v, int x, int y) {
    if (to_core(x, y) <= radius_px(frame.depth(u, v))) frame.mask(u, v) = 0;
  });
}

// In wire arrays, wire is what lies on crests and background what lies in valleys; elsewhere the
// mask and what surrounds it.
void LearnFromStripes(const WireCandidates& frame, const WireColours& colours,
                      const ColourLookup& lookup, WireColourModel& model) {
  const StripeField stripes(ApplyPosterior(BinColours(frame.color), colours.posterior));
  const MaskImage in_arrays = PixelsInArrays(frame);
  MaskImage wire = frame.mask, background = BackgroundAround(frame.mask);
  for (size_t i = 0; i < wire.size(); ++i) wire.data()[i] &= !in_arrays.data()[i];
  ForEachColour(in_arrays, frame.depth, lookup, [&](int u, int v, int x, int y) {
    const StripePart part = stripes.At(x, y).part;
    wire(u, v) = part == StripePart::kCrest;
    background(u, v) = part == StripePart::kValley;
  });
  Learn(frame, wire, background, lookup, model);
}

}  // namespace

void VisitOptions(ColourGateOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"gate_frames", "frames", 0, 1000,
                 "Deviation: the wires' colours are learned from about so many frames; they part "
                 "wires side by side where depth is one sheet. 0 = not asked."},
                options.frames);
  visitor.Visit(
      {"max_colour_width", "m", 0, 0.2,
       "Deviation: what has the wires' colours in a disc of this diameter is a wire array that "
       "colours do not resolve either, and left to other views; 0 = not asked."},
      options.max_width);
}

MaskImage PixelsInArrays(const WireCandidates& frame) {
  const int factor = Divisor(frame.mask, frame.arrays);
  const MaskImage arrays = Dilated(frame.arrays, (frame.array_margin + factor - 1) / factor);
  MaskImage in_arrays = frame.mask;
  for (int v = 0; v < in_arrays.height(); ++v) {
    for (int u = 0; u < in_arrays.width(); ++u) {
      in_arrays(u, v) &= arrays(std::min(u / factor, arrays.width() - 1),
                                std::min(v / factor, arrays.height() - 1));
    }
  }
  return in_arrays;
}

WireColours LearnWireColours(const std::vector<WireCandidates>& frames, const Sequence& sequence,
                             const ColourGateOptions& options) {
  WireColours colours;
  std::vector<MaskImage> background(frames.size());
  const WireColourModel first = LearnAll(frames.size(), [&](int64_t i, WireColourModel& model) {
    background[i] = BackgroundAround(frames[i].mask);
    Learn(frames[i], frames[i].mask, background[i], ColourLookup(sequence, Vec2::Zero()), model);
  });
  colours.posterior = first.Posterior();
  colours.shift_px = FindShift(frames, colours.posterior, sequence);
  const WireColourModel second = LearnAll(frames.size(), [&](int64_t i, WireColourModel& model) {
    WireCandidates gated = frames[i];
    GateByColour(colours, sequence, options, gated);
    Learn(gated, gated.mask, background[i], ColourLookup(sequence, colours.shift_px), model);
  });
  colours.posterior = second.Posterior();
  return colours;
}

void SharpenColours(const std::vector<WireCandidates>& frames, const Sequence& sequence,
                    WireColours& colours) {
  const ColourLookup lookup(sequence, colours.shift_px);
  for (int round = 0; round < kSharpeningRounds; ++round) {
    const WireColourModel model = LearnAll(frames.size(), [&](int64_t i, WireColourModel& m) {
      LearnFromStripes(frames[i], colours, lookup, m);
    });
    colours.posterior = model.Posterior();
  }
}

void ThinToCrests(const WireColours& colours, const Sequence& sequence, WireCandidates& frame) {
  const MaskImage in_arrays = PixelsInArrays(frame);
  if (!AnySet(in_arrays)) return;
  const StripeField stripes(ApplyPosterior(BinColours(frame.color), colours.posterior));
  ForEachColour(in_arrays, frame.depth, ColourLookup(sequence, colours.shift_px),
                [&](int u, int v, int x, int y) {
                  const StripePart part = stripes.At(x, y).part;
                  if (part != StripePart::kCrest && part != StripePart::kPlateau) {
                    frame.mask(u, v) = 0;
                  }
                });
}

void GateByColour(const WireColours& colours, const Sequence& sequence,
                  const ColourGateOptions& options, WireCandidates& frame) {
  const MaskImage in_arrays = PixelsInArrays(frame);
  if (!AnySet(in_arrays)) return;
  const PosteriorImage posterior = ApplyPosterior(BinColours(frame.color), colours.posterior);
  const PosteriorImage peak = Dilated(posterior, kPeakReach_px);
  const ColourLookup lookup(sequence, colours.shift_px);
  if (options.max_width > 0) {
    DropUnresolved(posterior, lookup, sequence.color_camera.fx, options.max_width, in_arrays,
                   frame);
  }
  ForEachColour(in_arrays, frame.depth, lookup, [&](int u, int v, int x, int y) {
    const double limit = std::max(255 * kMinPosterior, kMinOfPeak * peak(x, y));
    if (posterior(x, y) < limit) frame.mask(u, v) = 0;
  });
}

}  // namespace curvefusion
