#pragma once

#include "meshing/junction_mesh.h"
#include "meshing/junction_union.h"

namespace curvefusion {

/// The last resort for a junction whose tubes cannot be united: a surface wrapped around all of
/// them (CGAL alpha_wrap_3; Portaneri et al. 2022), united with the unchanged ends of the stubs at
/// the cut rings. It closes crotches and gaps narrower than two thirds of the radius, has no
/// cavities and is thicker by a fiftieth of the radius. Nothing where that fails, too. Cost: a
/// second or more.
std::optional<UnionMesh> WrapJunction(const Junction& junction);

}  // namespace curvefusion
