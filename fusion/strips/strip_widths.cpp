#include "fusion/strips/strip_widths.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "fusion/strips/vanishing_color.h"
#include "fusion/strips/wire_color.h"
#include "kernel/parallel.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Chosen: strips in doubt are left out, as up to 30 images show each place (RadiusOptions).
constexpr int kRounds = 4;                  // colour from widths, widths from colour
constexpr double kClearWidths = 1.5;        // another curve must be farther away
constexpr int kHalfLengthPx = 4;            // of the stretch that a profile is averaged over
constexpr double kMinRoomPx = 4;            // less would cut wires off and take the rest for all
constexpr double kMinContrast = 15;         // grey levels, to both sides; chosen
constexpr int64_t kGrain = 16;              // samples looked at by one task; changes no result
constexpr double kMaxCenterSpreadPx = 1.5;  // from the strips around on the same edge
constexpr size_t kConsistencyReach = 3;     // strips before and behind one on its edge
constexpr double kMinSignificance = 4;      // standard deviations of a width
constexpr double kMaxMisfit = 3;            // standard deviations, of what no width explains
constexpr size_t kMinOwnStrips = 20;        // for an edge to have a colour of its own
constexpr double kSameColor = 0.08;         // radians between the directions of two colours
// The blurred flank of a curve beside a strip, which must not come into its background.
// Measured on a rack (training seed 1): with the next curve 10 to 11 px away strips are 11 % too
// thin, at 12 to 13 px 2 %.
constexpr double kFlankPx = 2.5;

// What MeasureStrip finds, in the order of the strips; those not measurable have width 0.
std::vector<ColoredStrip> MeasureColors(const std::vector<FoundStrip>& strips) {
  std::vector<ColoredStrip> colored(strips.size());
  ParallelFor(0, static_cast<int64_t>(strips.size()), kGrain, [&](int64_t i) {
    const auto colors = MeasureStrip(strips[i].profile, strips[i].position);
    if (colors) colored[i] = {strips[i].frame, strips[i].position.width_px, *colors};
  });
  return colored;
}

// How far the next curve stays away from what a strip is compared with; negative where it comes
// in. The width is that of the edge: with their own, strips measured too narrow would be chosen.
double BackgroundRoom(const FoundStrip& strip) {
  return strip.sample.clearance_px - strip.position.width_px - kStripMarginPx - kFlankPx;
}

// The colour of each edge: its own where it clearly differs from that of all.
std::map<EdgeId, WireColor> ColorsByEdge(const std::vector<FoundStrip>& strips,
                                         const std::vector<ColoredStrip>& colored) {
  std::vector<ColoredStrip> all, clear;
  std::map<EdgeId, std::vector<ColoredStrip>> by_edge;
  for (size_t i = 0; i < strips.size(); ++i) {
    if (colored[i].width_px <= 0) continue;
    all.push_back(colored[i]);
    if (BackgroundRoom(strips[i]) >= 0) clear.push_back(colored[i]);
    by_edge[strips[i].sample.edge].push_back(colored[i]);
  }
  std::map<EdgeId, WireColor> colors;
  if (all.empty()) return colors;
  ImageBlur blur;
  blur.chroma_px = CalibrateChromaBlur(all, blur);
  const WireColor estimated = EstimateWireColor(all, blur);
  const WireColor common = DrawnToVanishing(estimated, clear);
  for (const auto& [edge, own_strips] : by_edge) {
    const WireColor own = EstimateWireColor(own_strips, blur);
    const bool is_same = own.direction.cross(estimated.direction).norm() < kSameColor;
    colors[edge] = is_same || own_strips.size() < kMinOwnStrips ? common : own;
  }
  return colors;
}

// Width 0 where the strip is not explained by the colour of its edge.
std::vector<SolvedWidth> SolveAll(const std::vector<FoundStrip>& strips,
                                  const std::vector<ColoredStrip>& colored,
                                  const std::map<EdgeId, WireColor>& colors) {
  std::vector<SolvedWidth> solved(strips.size());
  for (size_t i = 0; i < strips.size(); ++i) {
    if (colored[i].width_px <= 0) continue;
    solved[i] = SolveWidth(colored[i], colors.at(strips[i].sample.edge));
    const bool is_sound = solved[i].significance >= kMinSignificance &&
                          solved[i].misfit <= kMaxMisfit &&
                          solved[i].width_px * kClearWidths <= strips[i].sample.clearance_px;
    if (!is_sound) solved[i].width_px = 0;
  }
  return solved;
}

// Gives every strip the width that its edge's strips agree on, and the centre of its mass.
void Reposition(const std::vector<SolvedWidth>& solved, double bin,
                std::vector<FoundStrip>& strips) {
  std::map<EdgeId, std::vector<double>> diameters;
  for (size_t i = 0; i < strips.size(); ++i) {
    if (solved[i].width_px <= 0) continue;
    diameters[strips[i].sample.edge].push_back(solved[i].width_px * strips[i].sample.metres_per_px);
  }
  for (size_t i = 0; i < strips.size(); ++i) {
    const auto own = diameters.find(strips[i].sample.edge);
    if (own == diameters.end() || solved[i].width_px <= 0) continue;
    FoundStrip& strip = strips[i];
    strip.position.center_px = StripCentroid(strip.profile, strip.position, solved[i].weights);
    strip.position.width_px = MostProminent(own->second, bin) / strip.sample.metres_per_px;
  }
}

// Strips whose background is clear; of an edge with few of them also the clearest others, as many
// as give it a diameter that weighs little: a curve in the background makes strips too narrow.
std::vector<size_t> BestStrips(const std::vector<FoundStrip>& strips,
                               const std::vector<SolvedWidth>& solved) {
  std::map<EdgeId, std::vector<std::pair<double, size_t>>> by_edge;
  for (size_t i = 0; i < strips.size(); ++i) {
    if (solved[i].width_px <= 0) continue;
    const double room = BackgroundRoom(strips[i]);
    by_edge[strips[i].sample.edge].emplace_back(-std::min(room, 0.0), i);
  }
  std::vector<size_t> best;
  for (auto& [edge, of_edge] : by_edge) {
    std::sort(of_edge.begin(), of_edge.end());  // by what is missing: 0 for clear ones
    for (size_t k = 0; k < of_edge.size(); ++k) {
      if (k >= kMinOwnStrips && of_edge[k].first > 0) break;
      best.push_back(of_edge[k].second);
    }
  }
  std::sort(best.begin(), best.end());
  return best;
}

// The median centre of the strips around strip i on the same edge.
double MedianCenterAround(const std::vector<FoundStrip>& strips, size_t i) {
  std::vector<double> centers;
  const size_t begin = i - std::min<size_t>(i, kConsistencyReach);
  const size_t end = std::min(strips.size(), i + kConsistencyReach + 1);
  for (size_t j = begin; j < end; ++j) {
    if (strips[j].sample.edge == strips[i].sample.edge) {
      centers.push_back(strips[j].position.center_px);
    }
  }
  return Median(std::move(centers));
}

// Drops the strips off the line of their neighbours; all belong to one image, ordered along edges.
std::vector<FoundStrip> KeepConsistent(const std::vector<FoundStrip>& strips) {
  std::vector<FoundStrip> kept;
  for (size_t i = 0; i < strips.size(); ++i) {
    const double distance = strips[i].position.center_px - MedianCenterAround(strips, i);
    if (std::abs(distance) <= kMaxCenterSpreadPx) kept.push_back(strips[i]);
  }
  return kept;
}

}  // namespace

std::vector<FoundStrip> FindStrips(const ColorImage& image, int frame,
                                   const std::vector<ProjectedSample>& samples,
                                   const RadiusOptions& options) {
  std::vector<FoundStrip> found(samples.size());
  ParallelFor(0, static_cast<int64_t>(samples.size()), kGrain, [&](int64_t i) {
    const ProjectedSample& sample = samples[i];
    // The window ends where the next curve, moved by the same pose error, would come in.
    const double max_width_px = std::min(options.max_diameter / sample.metres_per_px,
                                         sample.clearance_px - kStripMarginPx - 1);
    if (max_width_px < kMinRoomPx) return;
    const double half_width_px = options.search_px + 0.5 * max_width_px + kStripMarginPx + 1;
    StripProfile profile = ReadProfile(image, sample, half_width_px, kHalfLengthPx);
    const double search_px = std::min(options.search_px, 0.5 * sample.clearance_px);
    const auto position = FindStrip(profile, search_px, max_width_px, kMinContrast);
    if (position) found[i] = {frame, sample, std::move(profile), *position};
  });
  std::erase_if(found, [](const FoundStrip& strip) { return strip.position.width_px <= 0; });
  return KeepConsistent(found);
}

std::vector<StripWidth> SolveStripWidths(std::vector<FoundStrip> strips,
                                         const RadiusOptions& options) {
  std::vector<SolvedWidth> solved(strips.size());
  for (int round = 0; round < kRounds; ++round) {
    if (round > 0) Reposition(solved, options.histogram_bin, strips);
    const std::vector<ColoredStrip> colored = MeasureColors(strips);
    solved = SolveAll(strips, colored, ColorsByEdge(strips, colored));
  }
  std::vector<StripWidth> widths;
  for (const size_t i : BestStrips(strips, solved)) {
    const double diameter = solved[i].width_px * strips[i].sample.metres_per_px;
    if (diameter > options.max_diameter) continue;
    widths.push_back(
        {strips[i].sample.edge, strips[i].sample.arc_length, strips[i].frame, diameter});
  }
  return widths;
}

double MostProminent(const std::vector<double>& values, double bin) {
  if (values.empty()) return 0;
  const double largest = *std::max_element(values.begin(), values.end());
  std::vector<int> histogram(static_cast<size_t>(largest / bin) + 3);
  for (const double value : values) ++histogram[static_cast<size_t>(value / bin) + 1];
  const auto mass = [&histogram](size_t i) {
    return histogram[i - 1] + 2 * histogram[i] + histogram[i + 1];
  };
  size_t fullest = 1;
  for (size_t i = 1; i + 1 < histogram.size(); ++i) {
    if (mass(i) > mass(fullest)) fullest = i;
  }
  return (static_cast<double>(fullest) - 0.5) * bin;
}

}  // namespace curvefusion
