#pragma once

#include <vector>

#include "kernel/geometry.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// The generalised winding number of an open surface (Jacobson, Kavan and Sorkine-Hornung 2013):
/// how much of what is seen around a point is the back of the surface. 1 inside of a closed one, 0
/// outside; where the surface has holes, more than 1/2 is what they would enclose if they were
/// closed. Triangles far away are taken together, as dipoles (Barill et al. 2018).
class WindingNumber {
 public:
  /// Groups triangles by cells of `cell_size` metres.
  WindingNumber(const TriangleMesh& mesh, double cell_size);

  /// Cost: the groups, and the triangles of near ones. Thread-safe.
  double At(const Vec3& p) const;

 private:
  struct Group {
    Vec3 center = Vec3::Zero();  // of the area
    Vec3 dipole = Vec3::Zero();  // sum of area times normal
    double radius = 0;
    double area = 0;
    std::vector<size_t> triangles;
  };

  TriangleMesh mesh_;
  std::vector<Group> groups_;
};

}  // namespace curvefusion
