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
      first_plane_(static_cast<int>(scene.capsules.size())),
      first_box_(first_plane_ + static_cast<int>(scene.planes.size())),
      columns_((camera.width + kTile - 1) / kTile) {
  const int row_count = (camera.height + kTile - 1) / kTile;
  const Eigen::Quaterniond first(T_world_first.rotation());
  const Eigen::Quaterniond last(T_world_last.rotation());
  for (int row = 0; row < row_count; ++row) {
    const double share = (row + 0.5) / row_count;
    RowPose pose;
    pose.center = (1 - share) * T_world_first.translation() + share * T_world_last.translation();
    pose.rotation = first.slerp(share, last).toRotationMatrix();
    pose.corner = pose.rotation * Vec3(-camera.cx / camera.fx, -camera.cy / camera.fy, 1);
    pose.right = pose.rotation.col(0) / camera.fx;
    pose.down = pose.rotation.col(1) / camera.fy;
    rows_.push_back(pose);
  }
  FillTiles();
}

// Pixels from its centre to which a ball is seen. Off the axis it is seen as an ellipse; a fifth
// more covers it up to 60 degrees.
double SceneView::SeenMargin(double depth, double radius) const {
  return 1.2 * camera_.fx * radius / (depth - radius) + 1;
}

// Rows of tiles that may show something of it.
SceneView::TileRange SceneView::RowsAround(const RoundedHull& hull) const {
  double top = kNoHit;
  double bottom = -kNoHit;
  for (const RigidTransform& T_camera_world : {T_first_world_, T_last_world_}) {
    for (const Vec3& p_world : hull.points) {
      const Vec3 p = T_camera_world * p_world;
      if (p.z() < kNearest + hull.radius) return {0, static_cast<int>(rows_.size()) - 1};
      const double margin = SeenMargin(p.z(), hull.radius);
      const double center = camera_.Project(p).y();
      top = std::min(top, center - margin);
      bottom = std::max(bottom, center + margin);
    }
  }
  if (bottom < -0.5 || top > camera_.height) return {};
  return {TileRow(top), TileRow(bottom)};
}

// Columns of tiles that may show something of it in one row of tiles: a wire across the image
// crosses few of the tiles in the rectangle around it.
SceneView::TileRange SceneView::ColumnsAround(const RoundedHull& hull, int row) const {
  std::vector<Vec2> pixels;
  double margin = 0;
  for (const Vec3& p_world : hull.points) {
    const Vec3 p = rows_[row].rotation.transpose() * (p_world - rows_[row].center);
    if (p.z() < kNearest + hull.radius) return {0, columns_ - 1};
    pixels.push_back(camera_.Project(p));
    margin = std::max(margin, SeenMargin(p.z(), hull.radius));
  }
  const double top = row * kTile - 0.5 - margin;
  const double bottom = (row + 1) * kTile - 0.5 + margin;
  double left = kNoHit;
  double right = -kNoHit;
  for (const Vec2& upper : pixels) {
    for (const Vec2& lower : pixels) {
      if (upper.y() > lower.y() || lower.y() < top || upper.y() > bottom) continue;
      const double slope = (lower.x() - upper.x()) / (lower.y() - upper.y());
      const double enters = upper.y() < top ? upper.x() + (top - upper.y()) * slope : upper.x();
      const double leaves =
          lower.y() > bottom ? upper.x() + (bottom - upper.y()) * slope : lower.x();
      left = std::min({left, enters - margin, leaves - margin});
      right = std::max({right, enters + margin, leaves + margin});
    }
  }
  if (right < -0.5 || left > camera_.width) return {};
  return {TileColumn(left), TileColumn(right)};
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

// The plane that alone is seen behind a square of tiles, -1 if there are several: they bound a
// convex room, so a plane that all four corners see fills the square.
int SceneView::PlaneBehind(int column, int row, int tiles) const {
  const double left = column * kTile - 0.5;
  const double top = row * kTile - 0.499;
  const double size = tiles * kTile - 0.002;
  const int first = NearestPlane(left, top);
  const bool alone = first >= 0 && first == NearestPlane(left + size, top) &&
                     first == NearestPlane(left, top + size) &&
                     first == NearestPlane(left + size, top + size);
  return alone ? first : -1;
}

// Of every tile; most are told by the square of 8x8 that they belong to.
std::vector<int> SceneView::PlanesBehind() const {
  constexpr int kSquare = 8;
  const int rows = static_cast<int>(rows_.size());
  std::vector<int> behind(static_cast<size_t>(columns_) * rows);
  for (int top = 0; top < rows; top += kSquare) {
    for (int left = 0; left < columns_; left += kSquare) {
      const int all = PlaneBehind(left, top, kSquare);
      for (int row = top; row < std::min(top + kSquare, rows); ++row) {
        for (int column = left; column < std::min(left + kSquare, columns_); ++column) {
          behind[row * columns_ + column] = all >= 0 ? all : PlaneBehind(column, row, 1);
        }
      }
    }
  }
  return behind;
}

// Whether a tile shows one face of a convex box and nothing else: all its corners do.
bool SceneView::IsFilledBy(const BoxSeen& seen, int tile) const {
  const SceneBox& box = *seen.box;
  if (box.wall > 0) return false;
  constexpr double kSameFace = 0.99;  // chosen: cosine between normals; round faces turn slowly
  const double left = tile % columns_ * kTile - 0.5;
  const double top = tile / columns_ * kTile - 0.499;
  const double size = kTile - 0.002;
  Vec3 face;
  for (int corner = 0; corner < 4; ++corner) {
    const SceneRay ray = RayThrough(left + corner % 2 * size, top + corner / 2 * size);
    const double depth = HitBox(seen, ray.direction);
    if (!(depth > kNearest && depth < kNoHit)) return false;
    const Vec3 normal = BoxNormal(box, ray.At(depth));
    if (corner == 0) face = normal;
    if (face.dot(normal) < kSameFace) return false;
  }
  return true;
}

void SceneView::FillTiles() {
  const int tiles = columns_ * static_cast<int>(rows_.size());
  std::vector<std::vector<Candidate>> seen(tiles);
  // `see` keeps what a row of tiles sees of the primitive and returns its index.
  const auto bin = [&](int primitive, const RoundedHull& hull, const auto& see) {
    const TileRange rows = RowsAround(hull);
    for (int row = rows.first; row <= rows.last; ++row) {
      const TileRange columns = ColumnsAround(hull, row);
      if (columns.first > columns.last) continue;
      const Candidate candidate{primitive, see(rows_[row].center)};
      for (int column = columns.first; column <= columns.last; ++column) {
        seen[row * columns_ + column].push_back(candidate);
      }
    }
  };
  int primitive = 0;
  for (const SceneCapsule& capsule : scene_.capsules) {
    bin(primitive++, {{capsule.start, capsule.end}, capsule.radius}, [&](const Vec3& center) {
      capsules_.emplace_back(capsule, center);
      return static_cast<int>(capsules_.size()) - 1;
    });
  }
  primitive += static_cast<int>(scene_.planes.size());
  for (const SceneBox& box : scene_.boxes) {
    bin(primitive++, {Corners(box), 0}, [&](const Vec3& center) {
      boxes_.emplace_back(box, center);
      return static_cast<int>(boxes_.size()) - 1;
    });
  }
  const std::vector<int> behind = PlanesBehind();
  tile_begin_.push_back(0);
  for (int tile = 0; tile < tiles; ++tile) {
    const bool is_box = seen[tile].size() == 1 && seen[tile][0].primitive >= first_box_ &&
                        IsFilledBy(boxes_[seen[tile][0].seen], tile);
    const int alone = behind[tile];
    for (int plane = 0; !is_box && plane < static_cast<int>(scene_.planes.size()); ++plane) {
      if (alone < 0 || plane == alone) candidates_.push_back({first_plane_ + plane});
    }
    candidates_.insert(candidates_.end(), seen[tile].begin(), seen[tile].end());
    tile_begin_.push_back(static_cast<int>(candidates_.size()));
    is_uniform_.push_back(is_box || (alone >= 0 && seen[tile].empty()));
  }
}

// Calls `found` with what the ray crosses, in no order, until it returns true.
template <class Found>
void SceneView::ForEachHit(const SceneRay& ray, const Found& found) const {
  const Candidate* end = candidates_.data() + tile_begin_[ray.tile + 1];
  for (const Candidate* it = candidates_.data() + tile_begin_[ray.tile]; it != end; ++it) {
    const int primitive = it->primitive;
    const double depth =
        primitive < first_plane_ ? HitCapsule(capsules_[it->seen], ray.direction)
        : primitive < first_box_
            ? HitPlane(scene_.planes[primitive - first_plane_], ray.center, ray.direction)
            : HitBox(boxes_[it->seen], ray.direction);
    if (depth > kNearest && depth < kNoHit && found(RayHit{primitive, depth})) return;
  }
}

RayHit SceneView::Trace(const SceneRay& ray) const {
  RayHit nearest{-1, kNoHit};
  ForEachHit(ray, [&](const RayHit& hit) {
    if (hit.depth < nearest.depth) nearest = hit;
    return false;
  });
  if (nearest.primitive < 0) nearest.depth = 0;
  return nearest;
}

bool SceneView::IsHidden(double u, double v, double depth) const {
  if (u < -0.5 || v < -0.5 || u > camera_.width - 0.5 || v > camera_.height - 0.5) return false;
  const int tile = TileAt(u, v);
  if (ShowsPlane(tile)) return false;
  bool hidden = false;
  ForEachHit(RayThrough(u, v), [&](const RayHit& hit) {
    hidden = hit.depth < depth - kHiddenBy;
    return hidden;
  });
  return hidden;
}

Vec3 SceneView::Normal(int primitive, const Vec3& p_world) const {
  if (primitive < first_plane_) return CapsuleNormal(scene_.capsules[primitive], p_world);
  if (primitive < first_box_) return scene_.planes[primitive - first_plane_].normal;
  return BoxNormal(scene_.boxes[primitive - first_box_], p_world);
}

// On the plane normal . (p - point) = 0 depth is normal . (point - center) / normal . direction.
Vec2 SceneView::InverseDepthSlope(const SceneRay& ray, const RayHit& hit) const {
  const Vec3 from_center = hit.depth * ray.direction;
  const Vec3 normal = Normal(hit.primitive, ray.center + from_center);
  const RowPose& pose = rows_[ray.tile / columns_];
  return Vec2(normal.dot(pose.right), normal.dot(pose.down)) / normal.dot(from_center);
}

int SceneView::Surface(int primitive) const {
  if (primitive < 0) return 0;
  if (primitive < first_plane_) return scene_.capsules[primitive].material;
  if (primitive < first_box_) return 1 + primitive - first_plane_;
  return scene_.boxes[primitive - first_box_].material;
}

}  // namespace curvefusion
