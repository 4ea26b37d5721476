#pragma once

#include <nlohmann/json_fwd.hpp>

#include "apps/live/live_board.h"
#include "capture/sequence.h"
#include "fusion/live/live_snapshot.h"

namespace curvefusion {

/// The state of a live run (docs/live.md).
nlohmann::ordered_json StateJson(const LiveState& state);

/// How well each curve of a snapshot is known, in the order of its edges.
nlohmann::ordered_json SightingsJson(const LiveSnapshot& snapshot);

/// A snapshot as the page draws it: curves, figures of each, hints where to look from, and the
/// camera's path along `sample`, some of the frames so far.
nlohmann::ordered_json CurvesJson(const LiveSnapshot& snapshot, int number, const Sequence& sample);

}  // namespace curvefusion
