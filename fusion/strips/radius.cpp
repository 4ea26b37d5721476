#include "fusion/strips/radius.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "capture/frame_stream.h"
#include "fusion/strips/strip_samples.h"
#include "fusion/strips/strip_widths.h"
#include "fusion/strips/wire_chains.h"
#include "fusion/strips/wire_gauges.h"
#include "kernel/polyline.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Chosen: neighbours lie a few pixels apart in an image, and a strip of 6 px and its background fit
// between a sample and the border.
constexpr double kNeighbourStep = 0.002;  // metres, between points of curves kept clear of
constexpr double kBorderPx = 8;           // samples nearer to the image border are left out
// Chosen: with 10, one of three chairs gains nothing
// (docs/lab_notebook.md#wires-of-narrow-grids).
constexpr double kCrossingPx = 8;  // farther along a wire a curve may cross it
// Chosen: wires whose diameters differ by less pass for equal.
constexpr double kAgreement = 0.25;  // strips this near to the mode count, relative
constexpr int kMinStrips = 5;        // chosen: an edge with fewer that agree is not measured
// Measured: calibrated on the errors of diameters of simulated scans.
constexpr double kAlikeStrips = 3;      // so many strips err together
constexpr double kCommonError = 0.015;  // relative; of blur and shade, in all strips of a wire
// Chosen: a stretch has three places of the usual step (RadiusOptions::sample_step) and enough
// strips for a median; a change must exceed what neighbours and chance make of the diameter.
constexpr double kStretch = 0.03;     // metres, of an edge whose radius may vary
constexpr double kClearChange = 0.3;  // relative; less may come of other wires near by
constexpr double kErrorsApart = 4;    // standard errors, of the thickest and the thinnest stretch

template <class T>
void Append(std::vector<T> more, std::vector<T>& all) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

// The colour images of some frames, and the curves that are looked for in them.
struct ColourViews {
  const Sequence& sequence;
  std::vector<int> frames;
  std::vector<ColorImage> images;
  std::vector<CurveSample> neighbours;
};

ColourViews LoadViews(const SkeletonGraph& skeleton, const Sequence& sequence,
                      const std::vector<int>& frames) {
  ColourViews views{sequence, frames, {}, SampleStrips(skeleton, kNeighbourStep)};
  ForEachFrame(sequence, frames, {.depth = false, .color = true},
               [&](const DecodedFrame& frame) { views.images.push_back(frame.color); });
  return views;
}

// Calls visit(image, frame, projected samples) for each view.
template <class Visit>
void ForEachProjection(const ColourViews& views, const std::vector<CurveSample>& samples,
                       const StripSight& sight, const Visit& visit) {
  const Sequence& sequence = views.sequence;
  for (size_t i = 0; i < views.frames.size(); ++i) {
    visit(views.images[i], views.frames[i],
          ProjectSamples(samples, views.neighbours, sequence.color_camera,
                         sequence.T_color_world(views.frames[i]), kBorderPx, sight));
  }
}

// Strips with no other curve near by; of wires that have few of those the ones with none beside:
// curves that cross the wire a little farther on leave most of its background as it is.
std::vector<StripWidth> MeasureStrips(const ColourViews& views, std::vector<CurveSample> samples,
                                      const SkeletonGraph& skeleton, const RadiusOptions& options) {
  std::vector<FoundStrip> found;
  const auto find = [&](const ColorImage& image, int frame, const auto& projected) {
    Append(FindStrips(image, frame, projected, options), found);
  };
  ForEachProjection(views, samples, {}, find);
  std::vector<StripWidth> widths = SolveStripWidths(found, options);

  const std::map<EdgeId, int> wires = WiresOfEdges(skeleton);
  std::map<int, int> strips_of_wire;
  for (const StripWidth& strip : widths) ++strips_of_wire[wires.at(strip.edge)];
  const auto is_measured = [&](EdgeId edge) {
    const auto strips = strips_of_wire.find(wires.at(edge));
    return strips != strips_of_wire.end() && strips->second >= kMinStrips;
  };
  std::erase_if(samples, [&](const CurveSample& sample) { return is_measured(sample.edge); });
  if (samples.empty()) return widths;
  std::erase_if(found, [&](const FoundStrip& strip) { return !is_measured(strip.sample.edge); });
  std::erase_if(widths, [&](const StripWidth& strip) { return !is_measured(strip.edge); });
  StripSight between_crossings;
  between_crossings.max_along_px = kCrossingPx;
  ForEachProjection(views, samples, between_crossings, find);
  for (const StripWidth& strip : SolveStripWidths(std::move(found), options)) {
    if (!is_measured(strip.edge)) widths.push_back(strip);
  }
  return widths;
}

struct Agreement {
  double diameter = 0;
  double spread = 0;
  int count = 0;
};

// Median and spread of the diameters that agree with the most prominent one.
Agreement Agree(const std::vector<double>& diameters, const RadiusOptions& options) {
  Agreement agreement;
  const double mode = MostProminent(diameters, options.histogram_bin);
  std::vector<double> agreeing;
  for (const double diameter : diameters) {
    if (std::abs(diameter - mode) <= kAgreement * mode) agreeing.push_back(diameter);
  }
  agreement.count = static_cast<int>(agreeing.size());
  if (agreeing.empty()) return agreement;
  agreement.diameter = Median(agreeing);
  for (double& diameter : agreeing) diameter -= agreement.diameter;
  agreement.spread = RobustDeviation(std::move(agreeing));
  return agreement;
}

// The diameter of an edge: that of its wire, unless the edge's own strips clearly tell another.
Agreement ChooseAgreement(const Agreement& own, const Agreement& wire) {
  const bool differs = std::abs(own.diameter - wire.diameter) > kAgreement * wire.diameter;
  return differs && own.count >= MeasuredDiameter::kEnoughStrips ? own : wire;
}

// The standard error of a diameter, as calibrated on simulated scans.
double StandardError(const Agreement& agreement) {
  const double of_strips = agreement.spread * std::sqrt(kAlikeStrips / agreement.count);
  return std::hypot(of_strips, kCommonError * agreement.diameter);
}

std::vector<double> DiametersOf(const std::vector<StripWidth>& strips) {
  std::vector<double> diameters;
  diameters.reserve(strips.size());
  for (const StripWidth& strip : strips) diameters.push_back(strip.diameter);
  return diameters;
}

std::map<int, Agreement> AgreeByWire(const std::map<int, std::vector<double>>& diameters,
                                     const RadiusOptions& options) {
  std::map<int, Agreement> agreements;
  for (const auto& [wire, of_wire] : diameters) agreements[wire] = Agree(of_wire, options);
  return agreements;
}

std::vector<MeasuredDiameter> GaugesOf(const std::map<int, Agreement>& wires) {
  std::vector<MeasuredDiameter> measured;
  for (const auto& [wire, agreed] : wires) {
    if (agreed.count >= kMinStrips) measured.push_back({agreed.diameter, agreed.count});
  }
  return FindGauges(std::move(measured));
}

// The radii of the stretches of one edge, from its strips.
std::vector<RadiusAt> RadiiAlong(std::vector<StripWidth> strips, const RadiusOptions& options) {
  std::sort(strips.begin(), strips.end(),
            [](const auto& a, const auto& b) { return a.arc_length < b.arc_length; });
  std::vector<RadiusAt> along;
  Agreement least, most;
  for (size_t begin = 0, end = 0; begin < strips.size(); begin = end) {
    std::vector<double> diameters, places;
    for (; end < strips.size(); ++end) {
      const double place = strips[end].arc_length;
      if (diameters.size() >= MeasuredDiameter::kEnoughStrips && place > places.front() + kStretch)
        break;
      diameters.push_back(strips[end].diameter);
      places.push_back(place);
    }
    const Agreement agreed = Agree(diameters, options);
    if (agreed.count < MeasuredDiameter::kEnoughStrips) continue;
    along.push_back({Median(std::move(places)), 0.5 * agreed.diameter});
    if (least.count == 0 || agreed.diameter < least.diameter) least = agreed;
    if (most.count == 0 || agreed.diameter > most.diameter) most = agreed;
  }
  const double difference = most.diameter - least.diameter;
  const bool varies =
      along.size() > 1 && difference > kClearChange * least.diameter &&
      difference > kErrorsApart * std::hypot(StandardError(least), StandardError(most));
  if (!varies) along.clear();
  return along;
}

void Summarize(const SkeletonGraph& skeleton, const RadiusOptions& options,
               RadiusEstimate& estimate) {
  const std::map<EdgeId, int> wires = WiresOfEdges(skeleton);
  std::map<EdgeId, std::vector<StripWidth>> by_edge;
  std::map<int, std::vector<double>> by_wire;
  for (const StripWidth& strip : estimate.strips) {
    by_edge[strip.edge].push_back(strip);
    by_wire[wires.at(strip.edge)].push_back(strip.diameter);
  }
  const std::vector<double> all = DiametersOf(estimate.strips);
  estimate.global_radius = 0.5 * Agree(all, options).diameter;
  std::map<int, Agreement> agreed_by_wire = AgreeByWire(by_wire, options);
  const std::vector<MeasuredDiameter> gauges = GaugesOf(agreed_by_wire);
  estimate.unmeasured_radius =
      gauges.empty() ? estimate.global_radius : 0.5 * gauges.front().diameter;
  for (const EdgeId edge : skeleton.Edges()) {
    const Agreement agreed =
        ChooseAgreement(Agree(DiametersOf(by_edge[edge]), options), agreed_by_wire[wires.at(edge)]);
    if (agreed.count < kMinStrips) {
      estimate.edges.push_back({edge, 0, 0, agreed.count, {}});
      continue;
    }
    const double diameter =
        DrawnToGauge({agreed.diameter, agreed.count}, gauges, options.gauge_strips);
    estimate.edges.push_back({edge, 0.5 * diameter, 0.5 * StandardError(agreed), agreed.count,
                              RadiiAlong(by_edge[edge], options)});
  }
}

// Linear between the places, constant beyond them.
std::vector<double> InterpolatedRadii(const Polyline& points, const std::vector<RadiusAt>& along) {
  std::vector<double> radii;
  for (const double place : CumulativeLength(points)) {
    const auto after = std::find_if(along.begin(), along.end(),
                                    [&](const RadiusAt& at) { return at.arc_length >= place; });
    if (after == along.begin() || after == along.end()) {
      radii.push_back(after == along.end() ? along.back().radius : after->radius);
      continue;
    }
    const RadiusAt& before = *std::prev(after);
    const double share = (place - before.arc_length) / (after->arc_length - before.arc_length);
    radii.push_back(before.radius + share * (after->radius - before.radius));
  }
  return radii;
}

}  // namespace

RadiusEstimate EstimateRadius(const SkeletonGraph& skeleton, const Sequence& sequence,
                              const std::vector<int>& frames, const RadiusOptions& options) {
  RadiusEstimate estimate;
  const ColourViews views =
      LoadViews(skeleton, sequence, EvenlyThinned(frames, options.max_frames));
  estimate.strips =
      MeasureStrips(views, SampleStrips(skeleton, options.sample_step), skeleton, options);
  Summarize(skeleton, options, estimate);
  return estimate;
}

void AssignRadii(const RadiusEstimate& estimate, SkeletonGraph& skeleton) {
  if (estimate.global_radius <= 0) return;
  for (const EdgeRadius& own : estimate.edges) {
    if (!skeleton.HasEdge(own.edge)) continue;
    const SkeletonEdge& edge = skeleton.edge(own.edge);
    const double radius = own.radius > 0 ? own.radius : estimate.unmeasured_radius;
    std::vector<double> radii(edge.points.size(), radius);
    if (!own.along.empty()) radii = InterpolatedRadii(edge.points, own.along);
    skeleton.SetCurve(own.edge, edge.points, std::move(radii), edge.observations);
  }
}

void VisitOptions(RadiusOptions& options, OptionVisitor& visitor) {
  visitor.Visit(
      {"sample_step", "m", 0.0005, 0.1,
       "Distance along the curves of the places where widths are measured. CurveFusion 4.3 "
       "gives no number."},
      options.sample_step);
  visitor.Visit({"histogram_bin", "m", 0.00001, 0.01,
                 "Bin of the histogram of diameters. CurveFusion 4.3 gives no number."},
                options.histogram_bin);
  visitor.Visit({"max_frames", "frames", 1, 1000000,
                 "Colour images used; more are thinned evenly. CurveFusion 4.3 uses all; beyond 30 "
                 "the result hardly changes."},
                options.max_frames);
  visitor.Visit({"gauge_strips", "", 0, 100000,
                 "Deviation: an object is made of few gauges of wire: the diameter of a wire is "
                 "shrunk towards that of the wires like it, with the weight of so many strips."},
                options.gauge_strips);
  visitor.Visit({"search_px", "px", 0, 40,
                 "Deviation: how far from its projection a strip is looked for by the strip model, "
                 "since poses drift."},
                options.search_px);
  visitor.Visit({"max_diameter", "m", 0.001, 0.2,
                 "Wider strips are no wires. CurveFusion 5 shows wires up to 12 mm."},
                options.max_diameter);
}

}  // namespace curvefusion
