#pragma once

#include <vector>

#include "experiments/simulation/random.h"
#include "experiments/simulation/scene.h"

namespace curvefusion {

/// Materials a thing may be of.
struct Palette {
  int first = 0;
  int count = 1;

  int Draw(Random& random) const { return first + random.Integer(0, count - 1); }
};

/// A thing in its own frame, in metres: z up from its base, the viewer on the side of -y.
struct Thing {
  std::vector<SceneBox> boxes;
  std::vector<SceneCapsule> capsules;
  double radius = 0;  ///< of a circle about the origin that its base keeps within
  double height = 0;
  bool faces_front = false;  ///< looks like something from the front only
};

/// Something for a table: a stack or a row of books, a cup, a bottle, a monitor, a crate of slats,
/// a pot of leaves.
Thing MakeTableThing(Random& random, const Palette& palette);

/// For a wall, which lies in the plane y = 0 behind it: a board with books and cups; a cupboard's
/// doors with knobs.
Thing MakeShelf(Random& random, const Palette& palette);
Thing MakeDoor(Random& random, const Palette& palette);

/// A person's arm and hand: the finger tips at the origin, the arm towards +x.
Thing MakeArm(Random& random, const Palette& palette);

}  // namespace curvefusion
