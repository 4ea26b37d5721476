#pragma once

#include <string>

#include "fusion/funnel.h"
#include "fusion/reconstruction.h"
#include "fusion/trust.h"

namespace curvefusion {

/// How far a result may be trusted, two lines for the terminal.
std::string TrustLines(const Trust& trust);

/// What was left out as no proven wire, a line for the terminal; empty where nothing was.
std::string UncertainLine(const UnprovenLengths& lengths);

/// Which rule took most where nothing remained, a sentence: "34,017 of 34,063 candidates fell to
/// the colour check".
std::string WhyNothing(const Funnel& funnel);

/// The same of a run whose curves may come from colour images alone.
std::string WhyNothing(const Reconstruction& reconstruction);

}  // namespace curvefusion
