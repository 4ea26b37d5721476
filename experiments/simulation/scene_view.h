#pragma once

#include <algorithm>
#include <vector>

#include "experiments/simulation/scene.h"
#include "experiments/simulation/scene_primitives.h"
#include "kernel/camera.h"

namespace curvefusion {

/// What a ray meets first: a primitive (capsules, then planes, then boxes; -1 for nothing) and its
/// depth along the optical axis in metres.
struct RayHit {
  int primitive = -1;
  double depth = 0;
};

/// A ray through a pixel position, from the centre of projection while its row is read.
struct SceneRay {
  Vec3 center;
  Vec3 direction;  ///< as long as the ray where it is one metre deep
  int tile = 0;

  Vec3 At(double depth) const { return center + depth * direction; }
};

/// A scene seen through one camera, with the primitives binned by tiles of 8x8 pixels. The camera
/// may move while its rows are read (a rolling shutter): every row of tiles has its own pose. Keeps
/// a reference to the scene. Thread-safe for concurrent queries.
class SceneView {
 public:
  /// The poses of the first and the last row; equal ones for a global shutter.
  SceneView(const Scene& scene, const PinholeCamera& camera, const RigidTransform& T_world_first,
            const RigidTransform& T_world_last);

  /// The ray through a pixel position; beyond the image, in the tile nearest to it.
  SceneRay RayThrough(double u, double v) const {
    const int row = TileRow(v);
    const Vec3 in_camera((u - camera_.cx) / camera_.fx, (v - camera_.cy) / camera_.fy, 1);
    return {rows_[row].center, rows_[row].rotation * in_camera, row * columns_ + TileColumn(u)};
  }

  /// First hit of a ray, whose pixel position must lie in the image.
  RayHit Trace(const SceneRay& ray) const;
  RayHit Trace(double u, double v) const { return Trace(RayThrough(u, v)); }

  /// Whether something stands more than 1 mm in front of `depth` on the ray through a pixel
  /// position; nothing does outside the image.
  bool IsHidden(double u, double v, double depth) const;

  /// The world point on the ray through a pixel position at a depth.
  Vec3 PointAt(double u, double v, double depth) const { return RayThrough(u, v).At(depth); }

  /// Centre of projection while the row of a pixel position is read.
  const Vec3& Center(double v) const { return rows_[TileRow(v)].center; }

  /// Outward unit normal of a primitive at a point of its surface.
  Vec3 Normal(int primitive, const Vec3& p_world) const;

  /// Index into Scene::materials of a primitive.
  int Surface(int primitive) const;

  /// Whether the tile around a pixel can show one plane only, so that one ray tells all.
  bool IsUniform(int u, int v) const;

 private:
  static constexpr int kTile = 8;  // pixels

  struct TileRowPose {
    Vec3 center;
    Mat3 rotation;
  };
  struct TileRect {
    int first_column = 0, last_column = -1, first_row = 0, last_row = -1;
  };
  // What rays of a tile may hit.
  struct Candidate {
    int primitive;
    int capsule = -1;  // index into capsules_, -1 for what is none
  };

  int TileColumn(double u) const {
    return std::clamp(static_cast<int>(u + 0.5) / kTile, 0, columns_ - 1);
  }
  int TileRow(double v) const {
    return std::clamp(static_cast<int>(v + 0.5) / kTile, 0, static_cast<int>(rows_.size()) - 1);
  }
  TileRect RectAround(const std::vector<Vec3>& points, double radius) const;
  std::vector<TileRect> PrimitiveRects() const;
  int NearestPlane(double u, double v) const;
  std::vector<int> VisiblePlanes(int column, int row) const;
  void FillTiles();
  double HitDepth(const Candidate& candidate, const SceneRay& ray) const;

  const Scene& scene_;
  PinholeCamera camera_;
  RigidTransform T_first_world_;
  RigidTransform T_last_world_;
  int columns_;
  std::vector<TileRowPose> rows_;
  std::vector<int> tile_begin_;  // of each tile in candidates_, and the end
  std::vector<Candidate> candidates_;
  std::vector<CapsuleSeen> capsules_;  // each from every row of tiles that it may be seen in
};

}  // namespace curvefusion
