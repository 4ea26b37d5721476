#include "experiments/simulation/scene_view.h"

#include <algorithm>
#include <cmath>

namespace curvefusion {
namespace {

constexpr double kNearest = 0.02;  // nothing is seen nearer to the camera than this
constexpr double kHiddenBy = 1e-3;

}  // namespace

SceneView::SceneView(const Scene& scene, const PinholeCamera& camera,
                     const RigidTransform& T_world_first, const RigidTransform& T_world_last)
    : scene_(scene),
      camera_(camera),
      T_first_world_(T_world_first.inverse()),
      T_last_world_(T_world_last.inverse()),
      columns_((camera.width + kTile - 1) / kTile) {
  const int row_count = (camera.height + kTile - 1) / kTile;
  const Eigen::Quaterniond first(T_world_first.rotation());
  const Eigen::Quaterniond last(T_world_last.rotation());
  for (int row = 0; row < row_count; ++row) {
    const double share = (row + 0.5) / row_count;
    rows_.push_back({(1 - share) * T_world_first.translation() + share * T_world_last.translation(),
                     first.slerp(share, last).toRotationMatrix()});
  }
  FillTiles();
}

// Tiles that balls of `radius` about the points, and all between them, can touch.
SceneView::TileRect SceneView::RectAround(const std::vector<Vec3>& points, double radius) const {
  Eigen::AlignedBox2d pixels;
  for (const RigidTransform& T_camera_world : {T_first_world_, T_last_world_}) {
    for (const Vec3& p_world : points) {
      const Vec3 p = T_camera_world * p_world;
      if (p.z() < kNearest + radius) {
        return {0, columns_ - 1, 0, static_cast<int>(rows_.size()) - 1};
      }
      const Vec2 pixel = camera_.Project(p);
      // A ball off the axis is seen as an ellipse; a fifth more covers it up to 60 degrees.
      const double margin = 1.2 * camera_.fx * radius / (p.z() - radius) + 1;
      pixels.extend(Vec2(pixel - Vec2::Constant(margin)));
      pixels.extend(Vec2(pixel + Vec2::Constant(margin)));
    }
  }
  if (pixels.max().x() < -0.5 || pixels.max().y() < -0.5 || pixels.min().x() > camera_.width ||
      pixels.min().y() > camera_.height) {
    return {};
  }
  return {TileColumn(pixels.min().x()), TileColumn(pixels.max().x()), TileRow(pixels.min().y()),
          TileRow(pixels.max().y())};
}

// Of capsules and boxes; planes have none.
std::vector<SceneView::TileRect> SceneView::PrimitiveRects() const {
  std::vector<TileRect> rects;
  for (const SceneCapsule& capsule : scene_.capsules) {
    rects.push_back(RectAround({capsule.start, capsule.end}, capsule.radius));
  }
  rects.resize(rects.size() + scene_.planes.size());
  for (const SceneBox& box : scene_.boxes) rects.push_back(RectAround(Corners(box), 0));
  return rects;
}

int SceneView::NearestPlane(double u, double v) const {
  const SceneRay ray = RayThrough(u, v);
  int nearest = -1;
  double nearest_depth = kNoHit;
  for (size_t i = 0; i < scene_.planes.size(); ++i) {
    const double depth = HitPlane(scene_.planes[i], ray.center, ray.direction);
    if (depth < nearest_depth) nearest = static_cast<int>(i);
    nearest_depth = std::min(depth, nearest_depth);
  }
  return nearest;
}

// The planes bound a convex room, so a plane that all four corners of a tile see fills the tile.
std::vector<int> SceneView::VisiblePlanes(int column, int row) const {
  const double left = column * kTile - 0.5;
  const double top = row * kTile - 0.499;
  const double size = kTile - 0.002;
  const int first = NearestPlane(left, top);
  const bool alone = first >= 0 && first == NearestPlane(left + size, top) &&
                     first == NearestPlane(left, top + size) &&
                     first == NearestPlane(left + size, top + size);
  const int capsules = static_cast<int>(scene_.capsules.size());
  if (alone) return {capsules + first};
  std::vector<int> planes;
  for (size_t i = 0; i < scene_.planes.size(); ++i)
    planes.push_back(capsules + static_cast<int>(i));
  return planes;
}

void SceneView::FillTiles() {
  const int tiles = columns_ * static_cast<int>(rows_.size());
  std::vector<std::vector<Candidate>> seen(tiles);
  const std::vector<TileRect> rects = PrimitiveRects();
  for (size_t i = 0; i < rects.size(); ++i) {
    const bool is_capsule = i < scene_.capsules.size();
    for (int row = rects[i].first_row; row <= rects[i].last_row; ++row) {
      Candidate candidate{static_cast<int>(i)};
      if (is_capsule) {
        candidate.capsule = static_cast<int>(capsules_.size());
        capsules_.emplace_back(scene_.capsules[i], rows_[row].center);
      }
      for (int column = rects[i].first_column; column <= rects[i].last_column; ++column) {
        seen[row * columns_ + column].push_back(candidate);
      }
    }
  }
  tile_begin_.push_back(0);
  for (int tile = 0; tile < tiles; ++tile) {
    for (const int plane : VisiblePlanes(tile % columns_, tile / columns_)) {
      candidates_.push_back({plane});
    }
    candidates_.insert(candidates_.end(), seen[tile].begin(), seen[tile].end());
    tile_begin_.push_back(static_cast<int>(candidates_.size()));
  }
}

double SceneView::HitDepth(const Candidate& candidate, const SceneRay& ray) const {
  if (candidate.capsule >= 0) return HitCapsule(capsules_[candidate.capsule], ray.direction);
  const size_t plane = candidate.primitive - scene_.capsules.size();
  if (plane < scene_.planes.size())
    return HitPlane(scene_.planes[plane], ray.center, ray.direction);
  return HitBox(scene_.boxes[plane - scene_.planes.size()], ray.center, ray.direction);
}

RayHit SceneView::Trace(const SceneRay& ray) const {
  RayHit hit{-1, kNoHit};
  for (int k = tile_begin_[ray.tile]; k < tile_begin_[ray.tile + 1]; ++k) {
    const double depth = HitDepth(candidates_[k], ray);
    if (depth > kNearest && depth < hit.depth) hit = {candidates_[k].primitive, depth};
  }
  if (hit.primitive < 0) hit.depth = 0;
  return hit;
}

bool SceneView::IsHidden(double u, double v, double depth) const {
  if (u < -0.5 || v < -0.5 || u > camera_.width - 0.5 || v > camera_.height - 0.5) return false;
  const SceneRay ray = RayThrough(u, v);
  if (tile_begin_[ray.tile + 1] - tile_begin_[ray.tile] == 1) return false;
  for (int k = tile_begin_[ray.tile]; k < tile_begin_[ray.tile + 1]; ++k) {
    const double other = HitDepth(candidates_[k], ray);
    if (other > kNearest && other < depth - kHiddenBy) return true;
  }
  return false;
}

Vec3 SceneView::Normal(int primitive, const Vec3& p_world) const {
  const int capsules = static_cast<int>(scene_.capsules.size());
  const int planes = static_cast<int>(scene_.planes.size());
  if (primitive < capsules) {
    return CapsuleNormal(scene_.capsules[primitive], p_world);
  }
  if (primitive < capsules + planes) return scene_.planes[primitive - capsules].normal;
  return BoxNormal(scene_.boxes[primitive - capsules - planes], p_world);
}

int SceneView::Surface(int primitive) const {
  const int capsules = static_cast<int>(scene_.capsules.size());
  const int planes = static_cast<int>(scene_.planes.size());
  if (primitive < 0) return 0;
  if (primitive < capsules) return scene_.capsules[primitive].material;
  if (primitive < capsules + planes) return 1 + primitive - capsules;
  return scene_.boxes[primitive - capsules - planes].material;
}

bool SceneView::IsUniform(int u, int v) const {
  const int tile = TileRow(v) * columns_ + TileColumn(u);
  return tile_begin_[tile + 1] - tile_begin_[tile] == 1;
}

}  // namespace curvefusion
