#pragma once

#include <vector>

#include "capture/sequence.h"
#include "fusion/nets/net_wires.h"
#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

/// A smooth surface in which the wires of a net lie: heights above a plane.
struct NetSheet {
  static constexpr double kStep = 0.003;  ///< metres from height to height; chosen

  Vec3 origin;           ///< in the world: of the plane's rows and columns
  Mat3 axes;             ///< columns: along rows, along columns, upwards
  Image<float> heights;  ///< metres
  MaskImage known;       ///< 1 where depth shows something there

  double Width() const { return kStep * (heights.width() - 1); }
  double Height() const { return kStep * (heights.height() - 1); }

  /// At so many metres along rows and columns.
  bool IsKnown(double x, double y) const;
  double HeightAt(double x, double y) const;
  /// The same in the world.
  Vec3 At(double x, double y) const { return origin + axes * Vec3(x, y, HeightAt(x, y)); }
  /// How far a place in the world is above the surface, or what goes on beside it.
  double Above(const Vec3& p) const;
};

/// The sheets of nets as depth shows them: the planes around which most of it lies, one after the
/// other. Throws Error(kBadInput) for an image that cannot be read.
std::vector<NetSheet> SheetsOf(const Sequence& sequence, const Nets& nets);

}  // namespace curvefusion
