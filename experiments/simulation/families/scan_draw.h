#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/simulation/simulate.h"

namespace curvefusion {

/// What `simulate random` knows: ShapeFamilyNames, then `furnished` (an object of any of them amid
/// things that are no wires) and `room` (such things without any wire).
std::vector<std::string> FamilyNames();

/// A scan of a family with all that can be chosen about it drawn: object, room, camera, colours,
/// light, path, poses and registration, 60 to 400 frames. docs/simulator.md lists the ranges. The
/// same seed gives the same draw, which has another seed of its own (no two families share one),
/// and SimulateScan writes it to truth/settings.json. With a `sensor` that camera is held instead of
/// the drawn one, a phone with the poses and registered images of its own; all else is the same.
/// Throws Error(kUsage) for an unknown family or a sensor that is never drawn (`ideal`,
/// `artec_spider`).
SimulationOptions DrawScan(const std::string& family, uint64_t seed,
                           const std::string& sensor = "");

/// How far the wires' colour is from that of the table and the wall: root mean square over red,
/// green and blue of the reflectances' difference, 0 to 1, of whichever is nearer. 0 without wires.
double ColorContrast(const Scene& scene);

}  // namespace curvefusion
