#pragma once

#include <cstdint>

#include "experiments/simulation/scene.h"

namespace curvefusion {

/// Puts things into a scene that has a room and perhaps an object: books, cups, bottles, monitors,
/// crates of slats, pots of leaves, a person's arm, shelves and doors on the wall. None of them is
/// a wire: what is round is at least 14 mm thick (handles, knobs, fingers, stems) or wider than 30
/// mm, what is thinner is flat and at least 12 mm wide (slats, rims, leaves, covers). They keep
/// clear of the object and of the view to it. Up to `things` of them, as many as find room; the
/// first ones are the same for any number.
void Furnish(Scene& scene, int things, uint64_t seed);

}  // namespace curvefusion
