#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/simulation/objects.h"

namespace curvefusion {

/// Kinds of wire objects, each a distribution: `cage`, `grid`, `rack`, `trolley`, `chair`, `legs`,
/// `truss`, `net`, `tree`, `vine`, `stand`, `umbrella`, `wheel`, `scrolls`, `spring`, `knot`,
/// `cables`, `mixture`.
std::vector<std::string> ShapeFamilyNames();

/// An object of a family, .15 to .9 m large, of wires of 2.5 to 12 mm whose axes keep 8 mm apart
/// where they are not welded and do not touch; the same seed gives the same object. The ranges of
/// every dimension are listed in docs/simulator.md. Throws Error(kUsage) for another name.
WireObject MakeFamilyObject(const std::string& family, uint64_t seed);

}  // namespace curvefusion
