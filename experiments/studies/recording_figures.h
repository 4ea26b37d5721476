#pragma once

#include <map>
#include <string>

#include "capture/sequence.h"
#include "experiments/simulation/drift.h"

namespace curvefusion {

/// What a recording, real or simulated, shows of its sensor; figures by name, those left out that
/// it does not allow.
///
/// - `measured`: share of the pixels with depth; `small`: pixels in components of at most 20
///   pixels, `front`: those of them more than 30 mm in front of every component of more than 200
///   pixels within 15x15 pixels; medians of 12 frames. `components_6_20`, `components_21_160`:
///   components of these sizes a frame, means. Components are 4-neighbours whose depths differ by
///   less than 2 % and 4 mm.
/// - `shadow_left`: of gaps of 3 to 100 pixels in a row between two depths for which a projector 75
///   mm to the side casts a shadow of 5 pixels and more, the share that lies to the left of the
///   nearer side, as shadows of a projector to the right do. `shadow_width`: median of the width of
///   those over the width expected.
std::map<std::string, double> DepthFigures(const Sequence& sequence);

/// By how much depth of frames 30 apart disagrees, moved by their poses: `disagree_0.8`,
/// `disagree_1.2`, `disagree_1.6`, `disagree_2.5` in mm, medians over all points at these
/// distances, give or take .2 m (.3 m the last), of up to 40 pairs of frames. With `errors` the
/// poses are taken for true and moved by 20 draws of that error.
std::map<std::string, double> DisagreementFigures(const Sequence& sequence,
                                                  const PoseErrorModel* errors, uint64_t seed);

/// `color_offset_px`: mean distance between where edges of depth lie by the given colour camera and
/// by the one that is fitted to edges of colour, in pixels of a 640 px wide image.
std::map<std::string, double> ColorFigures(const Sequence& sequence);

}  // namespace curvefusion
