#include "fusion/solid_parts/solid_parts.h"

#include <numbers>
#include <utility>

#include "fusion/solid_parts/attached_ends.h"
#include "fusion/solid_parts/attached_surface.h"
#include "fusion/solid_parts/contact_faces.h"
#include "fusion/solid_parts/room_planes.h"
#include "fusion/solid_parts/solid_field.h"
#include "fusion/solid_parts/surface_triangles.h"
#include "fusion/volume/volume_fusion.h"

namespace curvefusion {

namespace {

// Half of what is thin to segmentation (segmentation.opening_radius; CurveFusion 4.1): a volume's
// surface so near to a wire is the wire's, what is no wider is no surface.
constexpr double kReach = 20 * kMillimetre;
// Chosen: a volume smears a surface by about as much; planes and tubes hold what is within.
constexpr double kBlurVoxels = 2;
constexpr int kStride = 2;            // every second frame, as of the best profile's volume
constexpr double kVoxelSize = 0.005;  // metres; chosen: a Kinect's noise at .7 m is 1 to 2 mm
// Metres, of what was seen from one side only. Chosen: two voxels, a volume holds nothing thinner.
constexpr double kThickness = 0.01;
constexpr double kMargin = 0.2;  // metres, around the curves; chosen: a pot or a mug beside

double AreaOf(const SurfaceTriangles& surface, const TriangleMarks& marks) {
  double area = 0;
  for (size_t i = 0; i < surface.size(); ++i) area += marks[i] ? surface.areas[i] : 0;
  return area;
}

// How far before a solid a wire may end: the volume's wires are its own so far, its surface is
// blurred, and the hidden side may lie as much deeper.
double EndReach(double voxel_size, double thickness) {
  return kReach + kBlurVoxels * voxel_size + thickness;
}

}  // namespace

SolidParts FindSolidParts(const TsdfVolume& volume, const Eigen::AlignedBox3d& box,
                          const SkeletonGraph& skeleton, double thickness) {
  SolidParts parts{.skeleton = skeleton};
  const double blur = kBlurVoxels * volume.voxel_size();
  const SurfaceTriangles surface = TrianglesWithin(volume.ExtractMesh(), box);
  const RoomPlanes room = FindRoomPlanes(surface, blur);
  const TriangleMesh flat_room = FlatRoom(surface.mesh, room);
  const TriangleMarks attached = FindAttachedSurface(surface, room.marks, skeleton, kReach, blur);
  const double disc = std::numbers::pi * kReach * kReach;
  for (const SurfacePiece& piece : PiecesOf(surface, attached)) {
    TriangleMarks marks(surface.size(), 0);
    for (const int i : piece.triangles) marks[i] = 1;
    TriangleMesh solid = SolidBehind({MarkedPart(surface.mesh, marks), flat_room,
                                      ContactFaces(surface, marks, room.planes, 2 * blur)},
                                     volume, thickness, disc * thickness);
    if (!solid.triangles.empty()) parts.solids.push_back(std::move(solid));
  }
  parts.skeleton = LedToSolids(skeleton, parts.solids, EndReach(volume.voxel_size(), thickness));
  parts.seen_area = AreaOf(surface, attached);
  parts.room_area = AreaOf(surface, room.marks);
  return parts;
}

SolidParts FindSolidParts(const Sequence& sequence, const SkeletonGraph& skeleton,
                          const Progress& progress) {
  if (skeleton.empty()) return {.skeleton = skeleton};
  Eigen::AlignedBox3d box = BoundsOf(skeleton);
  box.min().array() -= kMargin;
  box.max().array() += kMargin;
  const int64_t count = (sequence.frame_count() + kStride - 1) / kStride;
  int64_t done = 0;
  const TsdfVolume volume = FuseVolume(
      sequence, {.voxel_size = kVoxelSize}, kStride,
      [&] { progress("solid parts", ++done, count); }, box);
  return FindSolidParts(volume, box, skeleton, kThickness);
}

SkeletonGraph LedToSolids(SkeletonGraph skeleton, const std::vector<TriangleMesh>& solids) {
  return LedToSolids(std::move(skeleton), solids, EndReach(kVoxelSize, kThickness));
}

}  // namespace curvefusion
