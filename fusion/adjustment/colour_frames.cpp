#include "fusion/adjustment/colour_frames.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "capture/frame_stream.h"
#include "fusion/appearance/local_contrast.h"
#include "fusion/strips/edge_tracking.h"
#include "kernel/parallel.h"
#include "kernel/polyline.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Chosen: colours are learned where wire or background is certain, in spite of blur.
constexpr double kBorderPx = 6;      // of the image: vertices nearer to it are left out
constexpr double kCoreShare = 0.35;  // of the width to either side: wire for certain
constexpr double kBlurredPx = 2;     // beside the strip: neither
constexpr double kSidePx = 8;        // of background beyond
// Of the images that look at a vertex. Chosen on lampshade (ribs in the shade: .2 to .3 in the
// first round), cage 2 and chair 3 (most above .4).
constexpr double kTellingShare = 0.35;
// chosen (lampshade, umbrella, wine, cage, decoration, cage 2; .1 loses wires that few images
// show): of 60 images up to 3 show something beside a wire that none of them shows.
constexpr double kShowingShare = 0.05;
constexpr int kFewStrips = 8;        // of a vertex
constexpr double kEdgeSearchPx = 5;  // at most

// Chosen: so far a camera in a hand moves in three of 30 frames a second; frames nearer to one
// another tell little more (docs/colour_adjustment.md).
constexpr double kUsedStep = 15 * kMillimetre;
// Images take some .9 MB each. The first ones anchor the world; of the others so many that
// memory and time do not grow with a sequence. Chosen on a simulated cat of 700 frames: with 100
// even ones it stands farther beside its place (docs/lab_notebook.md).
constexpr size_t kFirstFrames = 40;
constexpr int kOtherFrames = 80;

// The vertices along all edges as curve samples; nodes once for every edge that ends there.
struct VertexSamples {
  std::vector<CurveSample> samples;
  std::vector<int> vertices;
};

VertexSamples SampleState(const CurveVertices& curves, const CurvePoseState& state) {
  VertexSamples all;
  for (size_t e = 0; e < curves.edges.size(); ++e) {
    Polyline points;
    for (const int vertex : curves.edges[e]) points.push_back(state.positions[vertex]);
    const std::vector<double> arc_lengths = CumulativeLength(points);
    const std::vector<Vec3> tangents = Tangents(points);
    for (size_t i = 0; i < points.size(); ++i) {
      if (tangents[i].isZero()) continue;
      all.samples.push_back({static_cast<EdgeId>(e), arc_lengths[i], points[i], tangents[i]});
      all.vertices.push_back(curves.edges[e][i]);
    }
  }
  return all;
}

// Calls visit(frame, projected samples) for all frames, in parallel.
template <class Visit>
void ProjectIntoFrames(const std::vector<CurveSample>& samples, const VertexSamples& all,
                       const CurvePoseProblem& problem, const CurvePoseState& state,
                       const StripSight& sight, const Visit& visit) {
  ParallelFor(0, static_cast<int64_t>(state.T_camera_world.size()), 1, [&](int64_t f) {
    visit(f, ProjectSamples(samples, all.samples, problem.color_camera,
                            problem.T_color_depth * state.T_camera_world[f], kBorderPx, sight));
  });
}

// The samples of vertices with few strips.
VertexSamples SamplesOfFewStrips(const VertexSamples& all, size_t vertex_count,
                                 const std::vector<FrameStrips>& strips) {
  std::vector<int> accepted(vertex_count);
  for (const FrameStrips& frame : strips) {
    for (const SeenStrip& seen : frame) accepted[seen.vertex] += seen.strip.accepted ? 1 : 0;
  }
  VertexSamples few;
  for (size_t i = 0; i < all.samples.size(); ++i) {
    if (accepted[all.vertices[i]] >= kFewStrips) continue;
    few.samples.push_back(all.samples[i]);
    few.vertices.push_back(all.vertices[i]);
  }
  return few;
}

std::optional<double> EdgeExcess(const PosteriorImage& posterior, const CurveVertices& curves,
                                 const FrameStrips& strips) {
  std::vector<WholeStrip> whole;
  for (const SeenStrip& seen : strips) {
    if (!seen.strip.accepted) continue;
    whole.push_back({seen.sample.pixel + seen.strip.offset_px * seen.sample.normal,
                     seen.sample.normal, seen.sample.WidthPx(curves.radii[seen.vertex])});
  }
  return MeasureEdgeExcess(posterior, std::move(whole));
}

int BinAt(const ColourBins& bins, const Vec2& pixel) {
  const int u = static_cast<int>(std::lround(pixel.x()));
  const int v = static_cast<int>(std::lround(pixel.y()));
  return bins.Contains(u, v) ? bins(u, v) : -1;
}

// What is expected where the curve is.
TrackedStrip StripAtPlace(const ProjectedSample& sample, double radius) {
  TrackedStrip strip;
  strip.width_px = sample.WidthPx(radius);
  return strip;
}

void LearnFromStrip(const ColourBins& bins, const ProjectedSample& sample,
                    const TrackedStrip& strip, WireColourModel& model) {
  const Vec2 centre = sample.pixel + strip.offset_px * sample.normal;
  const int core = static_cast<int>(kCoreShare * strip.width_px);
  for (int i = -core; i <= core; ++i) {
    const int bin = BinAt(bins, centre + i * sample.normal);
    if (bin >= 0) model.AddWire(static_cast<uint16_t>(bin));
  }
  const double edge_px = 0.5 * strip.width_px + kBlurredPx;
  if (sample.clearance_px < 2 * edge_px + kSidePx) return;
  for (double offset = edge_px; offset <= edge_px + kSidePx; offset += 1) {
    for (const int side : {-1, 1}) {
      const int bin = BinAt(bins, centre + side * offset * sample.normal);
      if (bin >= 0) model.AddBackground(static_cast<uint16_t>(bin));
    }
  }
}

// For each vertex whether strips were accepted in at least this share of the images that look at
// it.
std::vector<char> AcceptedInShare(double share, const std::vector<FrameStrips>& strips,
                                  size_t vertices) {
  std::vector<int> looked(vertices), accepted(vertices);
  for (const FrameStrips& frame : strips) {
    for (const SeenStrip& seen : frame) {
      ++looked[seen.vertex];
      accepted[seen.vertex] += seen.strip.accepted;
    }
  }
  std::vector<char> told(vertices);
  for (size_t i = 0; i < vertices; ++i) {
    told[i] = looked[i] > 0 && accepted[i] >= share * looked[i];
  }
  return told;
}

}  // namespace

std::vector<int> ChooseColourFrames(const Sequence& sequence, int max_stride) {
  int stride = 1;
  if (IsVideo(sequence)) {
    const double frames_per_step = std::round(kUsedStep / StepBetweenFrames(sequence, 0.5));
    stride = static_cast<int>(std::clamp<double>(frames_per_step, 1, max_stride));
  }
  std::vector<int> first, others;
  for (int i = 0; i < sequence.frame_count(); i += stride) {
    (first.size() < kFirstFrames ? first : others).push_back(i);
  }
  const std::vector<int> thinned = EvenlyThinned(others, kOtherFrames);
  first.insert(first.end(), thinned.begin(), thinned.end());
  return first;
}

ColourFrames LoadColourFrames(const Sequence& sequence, const std::vector<int>& indices) {
  ColourFrames frames;
  frames.indices = indices;
  ForEachFrame(sequence, indices, {.depth = false, .color = true},
               [&](const DecodedFrame& frame) { frames.bins.push_back(BinColours(frame.color)); });
  frames.posteriors.resize(indices.size());
  return frames;
}

std::vector<FrameStrips> ExpectStrips(const CurveVertices& curves, const CurvePoseProblem& problem,
                                      const CurvePoseState& state) {
  const VertexSamples all = SampleState(curves, state);
  std::vector<FrameStrips> seen(state.T_camera_world.size());
  const auto expect = [&](int64_t f, const std::vector<ProjectedSample>& projected) {
    for (const ProjectedSample& sample : projected) {
      const int vertex = all.vertices[sample.index];
      const TrackedStrip strip = StripAtPlace(sample, curves.radii[vertex]);
      if (sample.clearance_px <= 2 * strip.width_px + kSidePx) continue;
      seen[f].push_back({vertex, sample, strip});
    }
  };
  ProjectIntoFrames(all.samples, all, problem, state, {}, expect);
  return seen;
}

std::vector<FrameStrips> TrackCurves(const CurveVertices& curves, const CurvePoseProblem& problem,
                                     const CurvePoseState& state, const ColourFrames& frames,
                                     double search_px) {
  const VertexSamples all = SampleState(curves, state);
  std::vector<FrameStrips> seen(frames.size());
  const auto track = [&](int64_t f, const std::vector<ProjectedSample>& projected) {
    std::vector<double> radii;
    for (const ProjectedSample& sample : projected) {
      radii.push_back(curves.radii[all.vertices[sample.index]]);
    }
    for (const TrackedStrip& strip :
         TrackStrips(frames.posteriors[f], projected, radii, search_px)) {
      const ProjectedSample& sample = projected[strip.sample];
      seen[f].push_back({all.vertices[sample.index], sample, strip});
    }
  };
  ProjectIntoFrames(all.samples, all, problem, state, {}, track);
  return seen;
}

std::vector<FrameStrips> TrackEdges(const CurveVertices& curves, const CurvePoseProblem& problem,
                                    const CurvePoseState& state, const ColourFrames& frames,
                                    double search_px, const std::vector<FrameStrips>& strips) {
  const VertexSamples all = SampleState(curves, state);
  const VertexSamples few = SamplesOfFewStrips(all, curves.positions.size(), strips);
  std::vector<FrameStrips> found(frames.size());
  if (few.samples.empty()) return found;
  const auto track = [&](int64_t f, const std::vector<ProjectedSample>& projected) {
    const PosteriorImage& posterior = frames.posteriors[f];
    const std::optional<double> excess_px = EdgeExcess(posterior, curves, strips[f]);
    if (!excess_px) return;
    std::vector<char> is_whole(curves.positions.size(), 0);
    for (const SeenStrip& seen : strips[f]) {
      if (seen.strip.accepted) is_whole[seen.vertex] = 1;
    }
    for (const ProjectedSample& sample : projected) {
      const int vertex = few.vertices[sample.index];
      if (is_whole[vertex]) continue;
      const auto offset_px = FindCentreByEdges(posterior, sample, curves.radii[vertex], *excess_px,
                                               std::min(search_px, kEdgeSearchPx));
      if (!offset_px) continue;
      TrackedStrip strip;
      strip.offset_px = *offset_px;
      strip.accepted = true;
      found[f].push_back({vertex, sample, strip});
    }
  };
  ProjectIntoFrames(few.samples, all, problem, state, {.by_side = true}, track);
  return found;
}

std::vector<char> ToldByColour(const std::vector<FrameStrips>& strips, size_t vertices) {
  return AcceptedInShare(kTellingShare, strips, vertices);
}

std::vector<char> ShownByColour(const std::vector<FrameStrips>& strips, size_t vertices) {
  return AcceptedInShare(kShowingShare, strips, vertices);
}

double MedianWidthPx(const std::vector<FrameStrips>& strips) {
  std::vector<double> widths_px;
  for (const FrameStrips& frame : strips)
    for (const SeenStrip& seen : frame) widths_px.push_back(seen.strip.width_px);
  return widths_px.empty() ? 0 : Median(std::move(widths_px));
}

void LookUpFirst(const Sequence& sequence, const std::vector<uint8_t>& colours, double strip_px,
                 ColourFrames& frames) {
  frames.posteriors.clear();
  ForEachFrame(
      sequence, frames.indices, {.depth = false, .color = true}, [&](const DecodedFrame& frame) {
        PosteriorImage& image =
            frames.posteriors.emplace_back(LocalContrast(frame.color, strip_px));
        if (colours.empty()) return;
        const ColourBins& bins = frames.bins[frames.posteriors.size() - 1];
        const PosteriorImage coloured = ApplyPosterior(bins, colours);
        for (size_t i = 0; i < image.size(); ++i)
          image.data()[i] = static_cast<uint8_t>((image.data()[i] + coloured.data()[i]) / 2);
      });
}

double AcceptedShare(const std::vector<FrameStrips>& strips) {
  size_t all = 0, accepted = 0;
  for (const FrameStrips& frame : strips) {
    all += frame.size();
    accepted += std::count_if(frame.begin(), frame.end(),
                              [](const SeenStrip& seen) { return seen.strip.accepted; });
  }
  return all > 0 ? static_cast<double>(accepted) / static_cast<double>(all) : 0;
}

double AgreedShare(const std::vector<FrameStrips>& strips, size_t vertices) {
  const std::vector<char> told = ToldByColour(strips, vertices);
  size_t accepted = 0, agreed = 0;
  for (const FrameStrips& frame : strips) {
    for (const SeenStrip& seen : frame) {
      accepted += seen.strip.accepted;
      agreed += seen.strip.accepted && told[seen.vertex];
    }
  }
  return accepted > 0 ? static_cast<double>(agreed) / static_cast<double>(accepted) : 0;
}

void LearnColours(const std::vector<FrameStrips>& strips, const CurveVertices& curves,
                  ColourFrames& frames) {
  const std::vector<char> told = ToldByColour(strips, curves.positions.size());
  WireColourModel model;
  for (size_t f = 0; f < frames.size(); ++f) {
    for (const SeenStrip& seen : strips[f]) {
      if (seen.strip.accepted) LearnFromStrip(frames.bins[f], seen.sample, seen.strip, model);
      if (seen.strip.accepted || told[seen.vertex]) continue;
      const TrackedStrip place = StripAtPlace(seen.sample, curves.radii[seen.vertex]);
      if (!IsClear(seen.sample.clearance_px, place.width_px)) continue;
      LearnFromStrip(frames.bins[f], seen.sample, place, model);
    }
  }
  const std::vector<uint8_t> posterior = model.Posterior();
  ParallelFor(0, static_cast<int64_t>(frames.size()), 1,
              [&](int64_t f) { frames.posteriors[f] = ApplyPosterior(frames.bins[f], posterior); });
}

}  // namespace curvefusion
