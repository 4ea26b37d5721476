#include "experiments/simulation/scene_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvefusion {
namespace {

constexpr int kTile = 8;
constexpr double kNearest = 0.02;  // nothing is seen nearer to the camera than this
constexpr double kMiss = std::numeric_limits<double>::infinity();
constexpr double kHiddenBy = 1e-3;

// Parameter of the first crossing of a ray with a capsule. The capsule lies inside its infinite
// cylinder, so a ray that misses the cylinder misses all.
double HitCapsule(const SceneCapsule& capsule, const Vec3& origin, const Vec3& direction) {
  const Vec3 axis = capsule.end - capsule.start;
  const Vec3 from_start = origin - capsule.start;
  const double axis_axis = axis.squaredNorm();
  const double axis_direction = axis.dot(direction);
  const double axis_from = axis.dot(from_start);
  const double direction_direction = direction.squaredNorm();
  const double a = axis_axis * direction_direction - axis_direction * axis_direction;
  const double b = axis_axis * direction.dot(from_start) - axis_from * axis_direction;
  const double c = axis_axis * (from_start.squaredNorm() - capsule.radius * capsule.radius) -
                   axis_from * axis_from;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return kMiss;
  double along = axis_from;
  if (a > 0) {
    const double t = (-b - std::sqrt(discriminant)) / a;
    along = axis_from + t * axis_direction;
    if (along > 0 && along < axis_axis) return t;
  }
  const Vec3 from_ball = along <= 0 ? from_start : Vec3(origin - capsule.end);
  const double half_b = direction.dot(from_ball);
  const double ball_c = from_ball.squaredNorm() - capsule.radius * capsule.radius;
  const double ball = half_b * half_b - direction_direction * ball_c;
  return ball < 0 ? kMiss : (-half_b - std::sqrt(ball)) / direction_direction;
}

double HitPlane(const ScenePlane& plane, const Vec3& origin, const Vec3& direction) {
  const double approach = plane.normal.dot(direction);
  return approach < 0 ? (plane.offset - plane.normal.dot(origin)) / approach : kMiss;
}

// Between the world's directions and those of a box.
Vec3 IntoBox(const SceneBox& box, const Vec3& p) {
  const Vec2& h = box.heading;
  return {h.x() * p.x() + h.y() * p.y(), h.x() * p.y() - h.y() * p.x(), p.z()};
}
Vec3 OutOfBox(const SceneBox& box, const Vec3& p) {
  const Vec2& h = box.heading;
  return {h.x() * p.x() - h.y() * p.y(), h.x() * p.y() + h.y() * p.x(), p.z()};
}

double HitBox(const SceneBox& box, const Vec3& origin, const Vec3& direction) {
  const Vec3 o = IntoBox(box, origin - box.center);
  const Vec3 d = IntoBox(box, direction);
  double enter = -kMiss;
  double leave = kMiss;
  for (int axis = 0; axis < 3; ++axis) {
    const double near = (-box.half_size[axis] - o[axis]) / d[axis];
    const double far = (box.half_size[axis] - o[axis]) / d[axis];
    enter = std::max(enter, std::min(near, far));
    leave = std::min(leave, std::max(near, far));
  }
  return enter <= leave ? enter : kMiss;
}

std::vector<Vec3> Corners(const SceneBox& box) {
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k) {
    const Vec3 sign(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    corners.push_back(box.center + OutOfBox(box, sign.cwiseProduct(box.half_size)));
  }
  return corners;
}

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

int SceneView::TileColumn(double u) const {
  return std::clamp(static_cast<int>(u + 0.5) / kTile, 0, columns_ - 1);
}

int SceneView::TileRow(double v) const {
  return std::clamp(static_cast<int>(v + 0.5) / kTile, 0, static_cast<int>(rows_.size()) - 1);
}

Vec3 SceneView::Direction(double u, double v) const {
  return rows_[TileRow(v)].rotation *
         Vec3((u - camera_.cx) / camera_.fx, (v - camera_.cy) / camera_.fy, 1);
}

Vec3 SceneView::PointAt(double u, double v, double depth) const {
  return Center(v) + depth * Direction(u, v);
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
  const Vec3 direction = Direction(u, v);
  int nearest = -1;
  double nearest_depth = kMiss;
  for (size_t i = 0; i < scene_.planes.size(); ++i) {
    const double depth = HitPlane(scene_.planes[i], Center(v), direction);
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
  std::vector<std::vector<int>> primitives(tiles);
  const std::vector<TileRect> rects = PrimitiveRects();
  for (size_t i = 0; i < rects.size(); ++i) {
    for (int row = rects[i].first_row; row <= rects[i].last_row; ++row) {
      for (int column = rects[i].first_column; column <= rects[i].last_column; ++column) {
        primitives[row * columns_ + column].push_back(static_cast<int>(i));
      }
    }
  }
  tile_begin_.push_back(0);
  for (int tile = 0; tile < tiles; ++tile) {
    for (const int plane : VisiblePlanes(tile % columns_, tile / columns_)) {
      tile_primitives_.push_back(plane);
    }
    tile_primitives_.insert(tile_primitives_.end(), primitives[tile].begin(),
                            primitives[tile].end());
    tile_begin_.push_back(static_cast<int>(tile_primitives_.size()));
  }
}

double SceneView::HitDepth(int primitive, const Vec3& center, const Vec3& direction) const {
  const int capsules = static_cast<int>(scene_.capsules.size());
  const int planes = static_cast<int>(scene_.planes.size());
  if (primitive < capsules) return HitCapsule(scene_.capsules[primitive], center, direction);
  if (primitive < capsules + planes) {
    return HitPlane(scene_.planes[primitive - capsules], center, direction);
  }
  return HitBox(scene_.boxes[primitive - capsules - planes], center, direction);
}

RayHit SceneView::Trace(double u, double v) const {
  const Vec3 direction = Direction(u, v);
  const Vec3& center = Center(v);
  const int tile = TileRow(v) * columns_ + TileColumn(u);
  RayHit hit{-1, kMiss};
  for (int k = tile_begin_[tile]; k < tile_begin_[tile + 1]; ++k) {
    const double depth = HitDepth(tile_primitives_[k], center, direction);
    if (depth > kNearest && depth < hit.depth) hit = {tile_primitives_[k], depth};
  }
  if (hit.primitive < 0) hit.depth = 0;
  return hit;
}

bool SceneView::IsHidden(double u, double v, double depth) const {
  if (u < -0.5 || v < -0.5 || u > camera_.width - 0.5 || v > camera_.height - 0.5) return false;
  const int tile = TileRow(v) * columns_ + TileColumn(u);
  if (tile_begin_[tile + 1] - tile_begin_[tile] == 1) return false;
  const Vec3 direction = Direction(u, v);
  const Vec3& center = Center(v);
  for (int k = tile_begin_[tile]; k < tile_begin_[tile + 1]; ++k) {
    const double other = HitDepth(tile_primitives_[k], center, direction);
    if (other > kNearest && other < depth - kHiddenBy) return true;
  }
  return false;
}

Vec3 SceneView::Normal(int primitive, const Vec3& p_world) const {
  const int capsules = static_cast<int>(scene_.capsules.size());
  const int planes = static_cast<int>(scene_.planes.size());
  if (primitive < capsules) {
    const SceneCapsule& capsule = scene_.capsules[primitive];
    const Vec3 axis = capsule.end - capsule.start;
    const double along = (p_world - capsule.start).dot(axis) / axis.squaredNorm();
    return (p_world - capsule.start - std::clamp(along, 0.0, 1.0) * axis).normalized();
  }
  if (primitive < capsules + planes) return scene_.planes[primitive - capsules].normal;
  const SceneBox& box = scene_.boxes[primitive - capsules - planes];
  const Vec3 p = IntoBox(box, p_world - box.center).cwiseQuotient(box.half_size);
  int axis = 0;
  p.cwiseAbs().maxCoeff(&axis);
  return OutOfBox(box, Vec3::Unit(axis) * (p[axis] > 0 ? 1 : -1));
}

int SceneView::Surface(int primitive) const {
  return std::max(0, primitive - static_cast<int>(scene_.capsules.size()) + 1);
}

bool SceneView::IsUniform(int u, int v) const {
  const int tile = TileRow(v) * columns_ + TileColumn(u);
  return tile_begin_[tile + 1] - tile_begin_[tile] == 1;
}

}  // namespace curvefusion
