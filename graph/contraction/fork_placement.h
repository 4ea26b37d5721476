#pragma once

#include <optional>

#include "kernel/polyline.h"

namespace curvefusion {

/// A branch as it leaves a junction, with the stretch [first, last) of its points that other
/// branches do not blur.
struct ClearBranch {
  Polyline points;
  size_t first = 0;
  size_t last = 0;
};

/// Where one wire forks off another at a small angle: the point of the smooth curve through both
/// branches of the other that the continuation of the forking branch meets. The ridge of the two is
/// one for a long way, so that the branches seem to part 10 to 20 mm too far out. All curves are
/// parabolas fitted to the clear stretches. Nothing where the three branches are no such fork (the
/// straightest two turn by more, or the third leaves at more, than 40 degrees), or where the fits
/// would be carried on farther than they are long, leave more than two millimetres, miss one
/// another by more than `max_miss` or meet beyond `reach` from the junction.
std::optional<Vec3> ForkPosition(const std::vector<ClearBranch>& branches, double reach,
                                 double max_miss);

}  // namespace curvefusion
