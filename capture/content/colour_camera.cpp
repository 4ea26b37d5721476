#include "capture/content/colour_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "capture/content/edge_evidence.h"
#include "kernel/parallel.h"
#include "kernel/thinned.h"

namespace curvefusion {

namespace {

using Information = Eigen::Matrix<double, 5, 5>;

// Standard deviations of a broad prior around the given camera. Chosen: a colour camera taken for
// the depth camera has another focal length by 6 to 10 % (Kinect V1, PrimeSense; of D400 by 60 %,
// which the points outweigh) and lies 15 to 60 mm beside it; centres are off by some pixels. Above
// or below it lies by next to nothing (0 and 1.4 mm in extrinsics that owners of a D555 and a D400
// published): points of one distance do not tell that offset from the centre.
ColourParameters PriorDeviations(const EdgeEvidence& evidence) {
  return {0.1 * evidence.given_camera.fx, 10 * evidence.scale, 10 * evidence.scale, 0.03, 0.002};
}

constexpr double kFineSigma = 3;  // px; measured: the spread about a fitted camera
// Derived: an edge's distance is off by about 3 px, and 20 points along an edge are off together.
constexpr double kPointInformation = 1.0 / (3 * 3) / 20;
constexpr int kIterations = 12;
constexpr double kConverged = 0.02;  // px

// One Gauss-Newton step with weights exp(-d^2 / 2 sigma^2) (Welsch) and the prior.
ColourParameters Step(const EdgeEvidence& evidence, const ColourParameters& x,
                      const EdgeSelection& selection, double sigma) {
  Information a = Information::Zero();
  ColourParameters b = ColourParameters::Zero();
  for (const size_t i : selection) {
    const EdgePoint& point = evidence.points[i];
    const EdgeDistance& distance = evidence.distances[static_cast<size_t>(point.frame)];
    const Vec2 pixel = evidence.Project(x, point);
    if (!distance.Contains(pixel)) continue;
    const EdgeDistance::Sample sample = distance.Interpolated(pixel, point.direction);
    if (sample.distance >= 3 * sigma) continue;  // weighs nothing
    const double z = evidence.Depth(point);
    const double du = sample.du, dv = sample.dv * evidence.aspect();
    ColourParameters gradient;
    gradient << du * (point.position.x() + x[kTx]) / z + dv * (point.position.y() + x[kTy]) / z,
        sample.du, sample.dv, du * x[kF] / z, dv * x[kF] / z;
    const double weight = kPointInformation * Closeness(sample.distance, sigma);
    a.selfadjointView<Eigen::Lower>().rankUpdate(gradient, weight);
    b += weight * sample.distance * gradient;
  }
  const ColourParameters prior = PriorDeviations(evidence).array().square().inverse();
  a.diagonal() += prior;
  b += prior.cwiseProduct(x - evidence.Given());
  return -a.selfadjointView<Eigen::Lower>().ldlt().solve(b);
}

ColourParameters Refined(const EdgeEvidence& evidence, ColourParameters x,
                         const EdgeSelection& selection, double sigma) {
  for (int i = 0; i < kIterations; ++i) {
    const ColourParameters step = Step(evidence, x, selection, sigma);
    x += step;
    // Pixels at 1 m and in the image's corner.
    const double moved = 0.5 * std::abs(step[kF]) / x[kF] * evidence.given_camera.width +
                         std::abs(step[kCx]) + std::abs(step[kCy]) +
                         x[kF] * (std::abs(step[kTx]) + std::abs(step[kTy]));
    if (moved < kConverged * evidence.scale) break;
  }
  return x;
}

struct Start {
  ColourParameters x;
  double share;
};

void KeepBest(size_t count, std::vector<Start>& starts) {
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Start& a, const Start& b) { return a.share > b.share; });
  if (starts.size() > count) starts.resize(count);
}

// Chosen: .8 to 1.76 covers the focal lengths of a sensor's two cameras (the colour camera of a
// D400 has 1.6 times that of its depth), 48 px an offset of 60 mm at 0.7 m; the steps are those of
// the coarse sigma, 6 px (at the image's corner 4 % of f are 13 px).
constexpr int kShorterSteps = 5;
constexpr int kLongerSteps = 19;
constexpr double kFocalStep = 0.04;
constexpr int kRightSteps = 8;
constexpr int kDownSteps = 4;
constexpr double kShiftStep = 6;
constexpr double kCoarseSigma = 6;
constexpr size_t kSearchPoints = 1200;
constexpr size_t kRefinePoints = 3000;
constexpr size_t kStarts = 5;

// Focal lengths and shifts on a grid, the best first.
std::vector<Start> CoarseStarts(const EdgeEvidence& evidence, const EdgeSelection& selection) {
  std::vector<Start> grid;
  for (int f = -kShorterSteps; f <= kLongerSteps; ++f) {
    for (int right = -kRightSteps; right <= kRightSteps; ++right) {
      for (int down = -kDownSteps; down <= kDownSteps; ++down) {
        ColourParameters x = evidence.Given();
        x[kF] *= 1 + kFocalStep * f;
        x[kCx] += kShiftStep * evidence.scale * right;
        x[kCy] += kShiftStep * evidence.scale * down;
        grid.push_back({x, 0});
      }
    }
  }
  const EdgeSelection few = ThinnedTo(selection, kSearchPoints);
  ParallelFor(0, static_cast<int64_t>(grid.size()), 32, [&](int64_t i) {
    Start& start = grid[static_cast<size_t>(i)];
    start.share = EdgeShare(evidence, start.x, few, kCoarseSigma);
  });
  KeepBest(kStarts, grid);
  return grid;
}

// The same shift, brought about by the cameras' offset at the points' median depth.
ColourParameters ByOffset(const EdgeEvidence& evidence, ColourParameters x, double depth) {
  const ColourParameters given = evidence.Given();
  x[kTx] += (x[kCx] - given[kCx]) * depth / x[kF];
  x[kTy] += (x[kCy] - given[kCy]) * depth / (x[kF] * evidence.aspect());
  x[kCx] = given[kCx];
  x[kCy] = given[kCy];
  return x;
}

// Measured: the given share is 1.30 to 1.83 times the best one of a camera shifted by 24 or 36 px
// on 9 scans with registered colour, .76 to 1.18 times on 5 others.
constexpr double kDistinct = 1.25;

// Whether every shift of the given camera by some coarse steps makes it much worse: then nothing
// better is to be found far off.
bool IsDistinct(const EdgeEvidence& evidence, const EdgeSelection& selection) {
  const EdgeSelection few = ThinnedTo(selection, kSearchPoints);
  const ColourParameters given = evidence.Given();
  double most = 0;
  for (const int steps : {4, 6}) {
    for (const auto& [right, down] :
         {std::pair{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}) {
      ColourParameters x = given;
      x[kCx] += kShiftStep * evidence.scale * steps * right;
      x[kCy] += kShiftStep * evidence.scale * steps * down;
      most = std::max(most, EdgeShare(evidence, x, few, kFineSigma));
    }
  }
  return EdgeShare(evidence, given, few, kFineSigma) > kDistinct * most;
}

// Searches from the given camera and over the grid, and refines coarse to fine.
ColourParameters Fit(const EdgeEvidence& evidence, const EdgeSelection& selection) {
  if (IsDistinct(evidence, selection)) {
    return Refined(evidence, evidence.Given(), ThinnedTo(selection, kRefinePoints), kFineSigma);
  }
  std::vector<Start> starts;
  const double depth = MedianEdgeDepth(evidence);
  for (const Start& start : CoarseStarts(evidence, selection)) {
    starts.push_back(start);
    starts.push_back({ByOffset(evidence, start.x, depth), 0});
  }
  starts.push_back({evidence.Given(), 0});
  const EdgeSelection some = ThinnedTo(selection, kRefinePoints);
  ParallelFor(0, static_cast<int64_t>(starts.size()), 1, [&](int64_t i) {
    Start& start = starts[static_cast<size_t>(i)];
    for (const double sigma : {8.0, 5.0, kFineSigma}) {
      start.x = Refined(evidence, start.x, some, sigma);
    }
    start.share = EdgeShare(evidence, start.x, some, kFineSigma);
  });
  KeepBest(1, starts);
  return Refined(evidence, starts[0].x, selection, kFineSigma);
}

// Every other frame.
EdgeSelection Half(const EdgeEvidence& evidence, int parity) {
  EdgeSelection selection;
  for (size_t i = 0; i < evidence.points.size(); ++i) {
    if (evidence.points[i].frame % 2 == parity) selection.push_back(i);
  }
  return selection;
}

constexpr int kGroups = 6;  // chosen: of the jackknife, four frames each
constexpr size_t kJackknifePoints = 6000;

// All points but those of one stretch of frames.
EdgeSelection WithoutStretch(const EdgeEvidence& evidence, int stretch) {
  EdgeSelection selection;
  const int frames = static_cast<int>(evidence.distances.size());
  for (size_t i = 0; i < evidence.points.size(); ++i) {
    if (evidence.points[i].frame * kGroups / frames != stretch) selection.push_back(i);
  }
  return ThinnedTo(selection, kJackknifePoints);
}

// Standard errors by leaving out one stretch of frames after the other (jackknife): frames in turn
// would show the same edges and look surer than they are.
ColourParameters StandardErrors(const EdgeEvidence& evidence, const ColourParameters& x) {
  std::array<ColourParameters, kGroups> fits;
  ParallelFor(0, kGroups, 1, [&](int64_t i) {
    fits[static_cast<size_t>(i)] =
        Refined(evidence, x, WithoutStretch(evidence, static_cast<int>(i)), kFineSigma);
  });
  ColourParameters mean = ColourParameters::Zero(), sum = ColourParameters::Zero();
  for (const ColourParameters& fit : fits) mean += fit / kGroups;
  for (const ColourParameters& fit : fits) sum += (fit - mean).cwiseAbs2();
  return (sum * (kGroups - 1) / kGroups).cwiseSqrt();
}

void Fill(const EdgeEvidence& evidence, const ColourParameters& x, ColourCameraFit& fit) {
  fit.color_camera = evidence.given_camera;
  fit.color_camera.fx = x[kF];
  fit.color_camera.fy = x[kF] * evidence.aspect();
  fit.color_camera.cx = x[kCx];
  fit.color_camera.cy = x[kCy];
  fit.T_color_depth = evidence.T_color_depth;
  fit.T_color_depth.translation().head<2>() = Vec2(x[kTx], x[kTy]);
  const ColourParameters errors = StandardErrors(evidence, x);
  fit.f_error = errors[kF];
  fit.cx_error = errors[kCx];
  fit.cy_error = errors[kCy];
  fit.tx_error = errors[kTx];
  fit.ty_error = errors[kTy];
}

double HeldOutGain(const EdgeEvidence& evidence, const ColourParameters& x,
                   const EdgeSelection& held_out) {
  const double given = EdgeShare(evidence, evidence.Given(), held_out, kFineSigma);
  return given > 0 ? EdgeShare(evidence, x, held_out, kFineSigma) / given : 0;
}

// Chosen: five parameters from fewer points would rest on a handful of edges.
constexpr size_t kMinPoints = 1000;
constexpr size_t kMinFrames = 6;
constexpr double kMinEdgeShare = 0.005;  // of a grey, dark or blurred image

// When a fit is believed. Measured on 14 scans (docs/check.md): registered ones are displaced by
// 0.9 to 3.9 px, gain 1.00 to 1.08 and have shares of 0.44 to 0.70; the kitchen and the mug are
// displaced by 21 to 27 px, gain 1.8 to 2.1, have shares of 0.63 to 0.68, and halves of them
// disagree by less than 1 px.
// Measured: a simulated cage of 60 frames whose colour is shifted by 1, 4, 8, 12, 16 px is found
// with a recall of .950 .951 .921 .900 .891 (5 mm) and diameters wrong by .11 .14 .32 .83 1.36 mm.
// Of 38 random scans, those with registered colour are displaced by .2 to 6.8 px, the four with raw
// colour by 18 to 52.
constexpr double kMinDisplacement = 10;  // px
constexpr double kMaxDisagreement = 3;   // px
constexpr double kMinGain = 1.15;
constexpr double kMinShare = 0.4;

bool IsEnough(const EdgeEvidence& evidence) {
  double share = 0;
  for (const EdgeDistance& distance : evidence.distances) share += distance.edge_share();
  return evidence.points.size() >= kMinPoints && evidence.distances.size() >= kMinFrames &&
         share >= kMinEdgeShare * static_cast<double>(evidence.distances.size());
}

}  // namespace

bool ColourCameraFit::IsMisregistered() const {
  return measured && displacement_px > kMinDisplacement && disagreement_px < kMaxDisagreement &&
         held_out_gain > kMinGain && fitted_share > kMinShare;
}

ColourCameraFit FitColourCamera(const Sequence& sequence, const ColourCameraOptions& options) {
  ColourCameraFit fit;
  const EdgeEvidence evidence =
      GatherEdgeEvidence(sequence, options.frames, options.points_per_frame);
  fit.frames = static_cast<int>(evidence.distances.size());
  fit.points = static_cast<int>(evidence.points.size());
  fit.measured = IsEnough(evidence);
  if (!fit.measured) return fit;
  const EdgeSelection even = Half(evidence, 0), odd = Half(evidence, 1);
  const ColourParameters given = evidence.Given();
  const ColourParameters by_even = Fit(evidence, even), by_odd = Fit(evidence, odd);
  fit.disagreement_px = Displacement(evidence, by_even, by_odd);
  fit.held_out_gain =
      std::min(HeldOutGain(evidence, by_even, odd), HeldOutGain(evidence, by_odd, even));
  EdgeSelection all(evidence.points.size());
  std::iota(all.begin(), all.end(), size_t{0});
  const bool is_even_better =
      EdgeShare(evidence, by_even, all, kFineSigma) >= EdgeShare(evidence, by_odd, all, kFineSigma);
  const ColourParameters x = Refined(evidence, is_even_better ? by_even : by_odd, all, kFineSigma);
  fit.given_px = MeanEdgeDistance(evidence, given);
  fit.fitted_px = MeanEdgeDistance(evidence, x);
  fit.given_share = EdgeShare(evidence, given, all, kFineSigma);
  fit.fitted_share = EdgeShare(evidence, x, all, kFineSigma);
  fit.displacement_px = Displacement(evidence, given, x);
  fit.median_depth = MedianEdgeDepth(evidence);
  Fill(evidence, x, fit);
  return fit;
}

}  // namespace curvefusion
