#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "meshing/junction_mesh.h"
#include "meshing/junction_union.h"

namespace curvefusion {

/// One closed surface in place of stubs, which were cut inside their cut rings. Their unchanged
/// ends reach `overlap` (metres, at least) into it.
using CoreMaker =
    std::function<TriangleMesh(const std::vector<TriangleMesh>& stubs, double overlap)>;

/// A junction whose tubes cannot be united: another surface takes their place and is united with
/// their unchanged ends at the cut rings. Nothing where the ends do not fit.
std::optional<UnionMesh> ReplaceCore(const Junction& junction, const CoreMaker& make_core);

}  // namespace curvefusion
