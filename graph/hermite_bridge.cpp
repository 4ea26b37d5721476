#include "graph/hermite_bridge.h"

namespace curvefusion {

Polyline HermiteBridge(const Vec3& a, const Vec3& leaving, const Vec3& b, const Vec3& arriving) {
  constexpr int kSegments = 12;  // chosen: few degrees from one to the next
  const double length = (b - a).norm();
  const Vec3 start = length * leaving.normalized();
  const Vec3 end = length * arriving.normalized();
  Polyline curve{a};
  for (int i = 1; i < kSegments; ++i) {
    const double t = static_cast<double>(i) / kSegments;
    const double u = 1 - t;
    curve.push_back((1 + 2 * t) * u * u * a + t * u * u * start + (3 - 2 * t) * t * t * b -
                    t * t * u * end);
  }
  curve.push_back(b);
  return curve;
}

}  // namespace curvefusion
