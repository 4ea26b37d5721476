#pragma once

#include <string>

#include "capture/sequence.h"
#include "fusion/best/best_options.h"

namespace curvefusion {

/// Looks at some colour images and switches off the checks that they cannot serve: all of them
/// where the images show nothing; where they are grey, only that what has no measured diameter is
/// no wire. Returns what the user should know, empty where colours are of use. About 0.1 s.
std::string SwitchOffUselessColour(const Sequence& sequence, BestOptions& options);

}  // namespace curvefusion
