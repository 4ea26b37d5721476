#include "experiments/simulation/furniture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/simulation/furniture_makers.h"
#include "experiments/simulation/random.h"

namespace curvefusion {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kColors = 20;  // materials that the things of a room share

SurfaceMaterial DrawnMaterial(Random& random) {
  SurfaceMaterial material;
  const double value = random.Uniform(0.1, 0.9), tint = random.Uniform(0, 0.6);
  material.color = value * (Vec3::Constant(1 - tint) +
                            tint * Vec3(random.Uniform(), random.Uniform(), random.Uniform()));
  material.texture_contrast = random.Uniform(0.1, 0.6);
  material.texture_seed = random.Next();
  material.infrared_albedo = random.Uniform(0.3, 0.85);
  if (random.Chance(0.25)) material.shininess = random.Uniform(0.05, 0.3);
  return material;
}

// From a thing's own frame into the world.
void Place(const Thing& thing, const Vec3& at, double yaw, Scene& scene) {
  const Mat3 turn = Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix();
  for (SceneBox box : thing.boxes) {
    box.center = at + turn * box.center;
    box.rotation = turn * box.rotation;
    scene.boxes.push_back(box);
  }
  for (SceneCapsule capsule : thing.capsules) {
    capsule.start = at + turn * capsule.start;
    capsule.end = at + turn * capsule.end;
    scene.capsules.push_back(capsule);
  }
}

// A disc of the table that something stands on.
struct Footprint {
  Vec2 center;
  double radius = 0;
  double height = 0;
};

class Furnisher {
 public:
  Furnisher(Scene& scene, uint64_t seed) : scene_(scene), random_(seed, RandomStream::kFurniture) {
    has_object_ = !scene.capsules.empty();
    for (const SceneBox& box : scene.boxes) {
      taken_.push_back({box.center.head<2>(), box.half_size.head<2>().norm(), 0});
    }
    first_color_ = static_cast<int>(scene.materials.size());
    for (int i = 0; i < kColors; ++i) scene.materials.push_back(DrawnMaterial(random_));
    palette_ = {first_color_, kColors};
  }

  // One thing more; nothing where no place is found.
  void Add() {
    const double kind = random_.Uniform();
    if (kind < 0.12) return Hang(MakeShelf(random_, palette_), 0.25);
    if (kind < 0.18) return Hang(MakeDoor(random_, palette_), 0);
    if (kind < 0.26) return Reach(MakeArm(random_, palette_));
    Stand(MakeTableThing(random_, palette_));
  }

 private:
  bool IsFree(const Footprint& place) const {
    const Eigen::AlignedBox3d& object = scene_.object_bounds;
    if (has_object_) {
      constexpr double kClear = 0.05;
      const Vec2 nearest =
          place.center.cwiseMax(object.min().head<2>()).cwiseMin(object.max().head<2>());
      const bool below = scene_.TableHeight() + place.height < object.min().z() - 0.01;
      const bool in_front = place.center.y() < object.center().y();
      if (!below && (in_front || (nearest - place.center).norm() < place.radius + kClear)) {
        return false;
      }
    }
    return std::all_of(taken_.begin(), taken_.end(), [&](const Footprint& other) {
      return (other.center - place.center).norm() > other.radius + place.radius;
    });
  }

  void Stand(const Thing& thing) {
    constexpr int kAttempts = 40;
    const Eigen::AlignedBox3d& object = scene_.object_bounds;
    const double wall = -scene_.planes[1].offset;
    const double front = object.min().y() - (has_object_ ? 0.05 : -0.05);
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const double reach = has_object_ ? 0.45 : 0.25;
      const Vec2 at(random_.Uniform(object.min().x() - reach, object.max().x() + reach),
                    random_.Uniform(front, wall - thing.radius));
      const Footprint place{at, thing.radius, thing.height};
      if (!IsFree(place)) continue;
      taken_.push_back(place);
      const double yaw =
          thing.faces_front ? random_.Uniform(-0.5, 0.5) : random_.Uniform(0, 2 * kPi);
      return Place(thing, {at.x(), at.y(), scene_.TableHeight()}, yaw, scene_);
    }
  }

  // On the wall behind, at one of a few places side by side.
  void Hang(const Thing& thing, double above) {
    const double wall = -scene_.planes[1].offset;
    const double x = scene_.object_bounds.center().x() + random_.Uniform(-0.7, 0.7);
    const bool free = std::all_of(hung_.begin(), hung_.end(), [&](const Footprint& other) {
      return std::abs(other.center.x() - x) > other.radius + thing.radius;
    });
    if (!free) return;
    hung_.push_back({Vec2(x, wall), thing.radius, 0});
    const double z = scene_.TableHeight() + above + (above > 0 ? random_.Uniform(0, 0.25) : 0);
    Place(thing, {x, wall, z}, 0, scene_);
  }

  // One arm comes from beside and stops short of the object.
  void Reach(const Thing& thing) {
    if (has_arm_) return;
    has_arm_ = true;
    const Eigen::AlignedBox3d& object = scene_.object_bounds;
    const double side = random_.Chance(0.5) ? 1 : -1;
    const double beside = side * (object.sizes().x() / 2 + random_.Uniform(0.05, 0.12));
    const Vec3 tip(object.center().x() + beside,
                   object.center().y() + random_.Uniform(0, 0.1) + object.sizes().y() / 4,
                   object.center().z() + random_.Uniform(-0.3, 0.3) * object.sizes().z());
    Place(thing, tip, (side > 0 ? 0 : kPi) + side * random_.Uniform(0, 0.5), scene_);
  }

  Scene& scene_;
  Random random_;
  bool has_object_ = false;
  bool has_arm_ = false;
  int first_color_ = 0;
  Palette palette_;
  std::vector<Footprint> taken_;
  std::vector<Footprint> hung_;
};

}  // namespace

void Furnish(Scene& scene, int things, uint64_t seed) {
  if (things == 0) return;
  Furnisher furnisher(scene, seed);
  for (int i = 0; i < things; ++i) furnisher.Add();
}

}  // namespace curvefusion
