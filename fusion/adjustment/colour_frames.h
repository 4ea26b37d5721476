#pragma once

#include <vector>

#include "capture/sequence.h"
#include "fusion/adjustment/curve_pose_solver.h"
#include "fusion/adjustment/curve_vertices.h"
#include "fusion/appearance/wire_posterior.h"
#include "fusion/strips/strip_tracking.h"

namespace curvefusion {

/// The colour images that curves are adjusted to, and what is known of the wires' colour.
struct ColourFrames {
  std::vector<int> indices;  ///< in sequence.frames, ascending
  std::vector<ColourBins> bins;
  std::vector<PosteriorImage> posteriors;

  size_t size() const { return indices.size(); }
};

/// The frames that curves are adjusted to: of views each of its own all, of a video every one that
/// is 15 mm from the last, or of a slow camera every max_stride-th; of more than 120 the first 40
/// and 80 of the others. Ascending.
std::vector<int> ChooseColourFrames(const Sequence& sequence, int max_stride);

/// Decodes the colour images of `indices`. Throws Error(kBadInput) where one cannot be read.
ColourFrames LoadColourFrames(const Sequence& sequence, const std::vector<int>& indices);

/// One strip of a vertex in one frame.
struct SeenStrip {
  int vertex = 0;
  ProjectedSample sample;
  TrackedStrip strip;
};

/// What one frame shows of the curves.
using FrameStrips = std::vector<SeenStrip>;

/// The places where the curves project to in each frame, with offset 0 and the expected width,
/// clear of other curves and of background beside them; none is accepted.
std::vector<FrameStrips> ExpectStrips(const CurveVertices& curves, const CurvePoseProblem& problem,
                                      const CurvePoseState& state);

/// Follows the strips of all curves through all frames. Parallel over frames.
std::vector<FrameStrips> TrackCurves(const CurveVertices& curves, const CurvePoseProblem& problem,
                                     const CurvePoseState& state, const ColourFrames& frames,
                                     double search_px);

/// Finds strips of vertices that have fewer than 8 accepted strips in all frames (`strips`, as
/// TrackCurves gives them) by those edges that other curves do not touch. All have `accepted`.
/// Parallel over frames.
std::vector<FrameStrips> TrackEdges(const CurveVertices& curves, const CurvePoseProblem& problem,
                                    const CurvePoseState& state, const ColourFrames& frames,
                                    double search_px, const std::vector<FrameStrips>& strips);

/// For each vertex whether so many of the images that look at it show a strip that colour alone
/// holds it.
std::vector<char> ToldByColour(const std::vector<FrameStrips>& strips, size_t vertices);

/// For each vertex whether so many of the images that look at it show a strip that these are of one
/// thing, not of whatever lies behind.
std::vector<char> ShownByColour(const std::vector<FrameStrips>& strips, size_t vertices);

/// The share of the strips that are accepted.
double AcceptedShare(const std::vector<FrameStrips>& strips);

/// The share of the accepted strips that are at vertices that colour alone holds (ToldByColour):
/// strips of wires are seen again and again in the same places, those of textures here and there.
double AgreedShare(const std::vector<FrameStrips>& strips, size_t vertices);

/// The width of the strips, pixels, in the median; 0 where there are none.
double MedianWidthPx(const std::vector<FrameStrips>& strips);

/// What images show before the wires' colours were learned, where places may be strips' widths off:
/// the mean of their contrast (LocalContrast, for strips of this width) and of the posterior of
/// `colours`, which may be empty. Decodes the images again, of which only bins of colours are kept.
void LookUpFirst(const Sequence& sequence, const std::vector<uint8_t>& colours, double strip_px,
                 ColourFrames& frames);

/// Learns the colours of wire and background around the strips of all frames and looks them up in
/// every image. Around vertices that colour does not tell (ToldByColour), where no other curve is
/// near, what lies at the curve's own place is learned as well: a wire in the shade, of which no
/// strip stands out, must not become background.
void LearnColours(const std::vector<FrameStrips>& strips, const CurveVertices& curves,
                  ColourFrames& frames);

}  // namespace curvefusion
