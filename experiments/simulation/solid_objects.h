#pragma once

#include <string>
#include <vector>

#include "experiments/simulation/scene.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// The wires of objects that have solid parts, too, and stand on the table: `seat` (a board on legs
/// with a back), `pot_plant`, `mug` (an open cup). False where `name` is none of them.
bool MakeSolidObject(const std::string& name, std::vector<WireCurve>& curves);

/// The solid parts that belong to the wires of an object, in its frame; none where it is not of
/// MakeSolidObject.
std::vector<SceneBox> SolidsOf(const WireObject& object);

/// The surface of a box or an upright cylinder, outward normals; round ones within .1 mm.
TriangleMesh SurfaceOf(const SceneBox& box);

}  // namespace curvefusion
