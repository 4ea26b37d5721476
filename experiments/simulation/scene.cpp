#include "experiments/simulation/scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/simulation/furniture.h"
#include "experiments/simulation/random.h"
#include "experiments/simulation/solid_objects.h"

namespace curvefusion {
namespace {

constexpr size_t kWall = 2;                // of the materials: after the wires and the table
constexpr double kLongestCapsule = 0.010;  // keeps the tiles a piece may touch few
constexpr double kTaperStep = 5e-5;  // of a radius from piece to piece: below what any sensor sees
constexpr double kFlat = 1.0 / 3;    // height over width below which an object is stood up

Eigen::AlignedBox3d Bounds(const WireObject& object, const std::vector<SceneBox>& solids) {
  Eigen::AlignedBox3d bounds;
  for (const WireCurve& curve : object.curves) {
    for (size_t i = 0; i < curve.points.size(); ++i) {
      const Vec3& p = curve.points[i];
      const double radius = curve.DiameterAt(i) / 2;
      bounds.extend(Vec3(p - Vec3::Constant(radius)));
      bounds.extend(Vec3(p + Vec3::Constant(radius)));
    }
  }
  for (const SceneBox& solid : solids) {
    bounds.extend(Vec3(solid.center - solid.half_size));
    bounds.extend(Vec3(solid.center + solid.half_size));
  }
  if (bounds.isEmpty()) bounds.extend(Vec3::Constant(-0.15)).extend(Vec3::Constant(0.15));
  return bounds;
}

// Stood up if flat and all of wire, and moved so that its bounding box is centred at the origin.
WireObject Placed(WireObject object, std::vector<SceneBox>& solids) {
  const Vec3 size = Bounds(object, solids).sizes();
  if (solids.empty() && size.z() < kFlat * std::min(size.x(), size.y())) {
    for (WireCurve& curve : object.curves) {
      for (Vec3& p : curve.points) p = Vec3(p.x(), -p.z(), p.y());
    }
  }
  const Vec3 center = Bounds(object, solids).center();
  for (WireCurve& curve : object.curves) {
    for (Vec3& p : curve.points) p -= center;
  }
  for (SceneBox& solid : solids) solid.center -= center;
  return object;
}

// A wire that tapers becomes a row of steps.
std::vector<SceneCapsule> Capsules(const WireObject& object) {
  std::vector<SceneCapsule> capsules;
  for (const WireCurve& curve : object.curves) {
    for (size_t i = 0; i + 1 < curve.points.size(); ++i) {
      const Vec3& a = curve.points[i];
      const Vec3& b = curve.points[i + 1];
      const double radius = curve.DiameterAt(i) / 2;
      const double growth = curve.DiameterAt(i + 1) / 2 - radius;
      const int pieces = std::max({1, static_cast<int>(std::ceil((b - a).norm() / kLongestCapsule)),
                                   static_cast<int>(std::ceil(std::abs(growth) / kTaperStep))});
      for (int k = 0; k < pieces; ++k) {
        capsules.push_back({a + (b - a) * k / pieces, a + (b - a) * (k + 1) / pieces,
                            radius + growth * (k + 0.5) / pieces});
      }
    }
  }
  return capsules;
}

Vec3 ColorOfHue(double hue, double saturation, double value) {
  const auto channel = [&](double shift) {
    const double k = std::fmod(hue * 6 + shift, 6.0);
    return value - value * saturation * std::clamp(std::min(k, 4 - k), 0.0, 1.0);
  };
  return {channel(5), channel(3), channel(1)};
}

SurfaceMaterial WireMaterial(const SceneOptions& options) {
  SurfaceMaterial material;
  material.color = ColorOfHue(options.wire_hue, options.wire_saturation, options.wire_albedo);
  material.infrared_albedo =
      options.wire_infrared_albedo < 0 ? options.wire_albedo : options.wire_infrared_albedo;
  material.shininess = options.wire_shininess;
  return material;
}

// In colour; to infrared it stays what it is.
void PaintAs(const SurfaceMaterial& other, SurfaceMaterial& material) {
  material.color = other.color;
  material.texture_contrast = other.texture_contrast;
  material.texture_seed = other.texture_seed;
}

// Matt and speckled, as wallpaper, wood or cardboard.
SurfaceMaterial BackgroundMaterial(Random& random, uint64_t texture_seed) {
  SurfaceMaterial material;
  material.color =
      ColorOfHue(random.Uniform(), random.Uniform(0.05, 0.3), random.Uniform(0.4, 0.75));
  material.texture_contrast = random.Uniform(0.4, 0.7);
  material.texture_seed = texture_seed;
  material.infrared_albedo = random.Uniform(0.5, 0.85);
  return material;
}

std::vector<ScenePlane> RoomAround(const Eigen::AlignedBox3d& object,
                                   const std::optional<double>& table_gap, Random& random) {
  constexpr double kSideWall = 1.0;  // beside the object, so that no view ends in nothing
  const double drawn_gap = random.Uniform(0.06, 0.10);  // also where it is not used: same room
  const double table = object.min().z() - table_gap.value_or(drawn_gap);
  const double wall = object.max().y() + random.Uniform(0.4, 0.6);
  return {{Vec3::UnitZ(), table},
          {-Vec3::UnitY(), -wall},
          {Vec3::UnitX(), object.min().x() - kSideWall},
          {-Vec3::UnitX(), -object.max().x() - kSideWall}};
}

// Whether a box's circumscribed circle keeps clear of the object and of the camera's side.
bool StandsClear(const SceneBox& box, const Eigen::AlignedBox3d& object) {
  constexpr double kClearance = 0.08;
  const double reach = box.half_size.head<2>().norm() + kClearance;
  const Vec3 nearest = box.center.cwiseMax(object.min()).cwiseMin(object.max());
  return (nearest - box.center).head<2>().norm() > reach && box.center.y() > object.center().y();
}

std::vector<SceneBox> BoxesAround(const Eigen::AlignedBox3d& object,
                                  const std::vector<ScenePlane>& room, Random& random) {
  constexpr int kAttempts = 200;
  const double table = room[0].offset;
  const double wall = -room[1].offset;
  const size_t count = 3 + random.Next() % 3;
  std::vector<SceneBox> boxes;
  for (int attempt = 0; attempt < kAttempts && boxes.size() < count; ++attempt) {
    SceneBox box;
    box.half_size = {random.Uniform(0.04, 0.10), random.Uniform(0.04, 0.10),
                     random.Uniform(0.05, 0.16)};
    const double yaw = random.Uniform(0, std::numbers::pi);
    box.rotation = Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix();
    const double reach = box.half_size.head<2>().norm();
    box.center = {random.Uniform(object.min().x() - 0.35, object.max().x() + 0.35),
                  random.Uniform(object.min().y(), wall - reach), table + box.half_size.z()};
    bool clear = StandsClear(box, object);
    for (const SceneBox& other : boxes) {
      const double gap = (other.center - box.center).head<2>().norm();
      clear = clear && gap > reach + other.half_size.head<2>().norm();
    }
    if (!clear) continue;
    box.material = static_cast<int>(1 + room.size() + boxes.size());
    boxes.push_back(box);
  }
  return boxes;
}

// The scene's last boxes, each of a material of its own.
void AddSolids(const std::vector<SceneBox>& solids, Random& random, uint64_t seed, Scene& scene) {
  for (SceneBox solid : solids) {
    const size_t material = scene.materials.size();
    const uint64_t texture_seed = Random(seed, RandomStream::kTexture, material).Next();
    scene.materials.push_back(BackgroundMaterial(random, texture_seed));
    solid.material = static_cast<int>(material);
    scene.boxes.push_back(solid);
  }
}

}  // namespace

void VisitOptions(SceneOptions& options, OptionVisitor& visitor) {
  visitor.Visit(
      {"wire_albedo", "", 0, 1,
       "Brightness of the wires in colour and infrared; CurveFusion 5, effect of colour."},
      options.wire_albedo);
  visitor.Visit(
      {"wire_hue", "", 0, 1, "Hue of the wires from red over green and blue; own choice."},
      options.wire_hue);
  visitor.Visit({"wire_saturation", "", 0, 1, "Saturation of the wires' colour; own choice."},
                options.wire_saturation);
  visitor.Visit({"wire_shininess", "", 0, 1,
                 "Share of light the wires mirror; CurveFusion 5, effect of colour."},
                options.wire_shininess);
  visitor.Visit({"furniture", "", 0, 40,
                 "Things in the room that are no wires: books, cups, slats, leaves; own choice."},
                options.furniture);
  visitor.Visit({"wire_infrared_albedo", "", -1, 1,
                 "Brightness of the wires in infrared; below 0 as in colour."},
                options.wire_infrared_albedo);
  visitor.Visit({"wire_like_background", "", 0, 1,
                 "Whether the wires have the colour of the wall behind them; own choice."},
                options.wire_like_background);
}

Scene MakeScene(const WireObject& object, const SceneOptions& options, uint64_t seed) {
  Random random(seed, RandomStream::kScene);
  Scene scene;
  std::vector<SceneBox> solids = SolidsOf(object);
  scene.object = Placed(object, solids);
  scene.object_bounds = Bounds(scene.object, solids);
  scene.capsules = Capsules(scene.object);
  std::optional<double> table_gap = options.table_gap;
  if (!solids.empty() && !table_gap) table_gap = 0;
  scene.planes = RoomAround(scene.object_bounds, table_gap, random);
  scene.boxes = BoxesAround(scene.object_bounds, scene.planes, random);
  scene.materials.push_back(WireMaterial(options));
  for (size_t i = 0; i < scene.planes.size() + scene.boxes.size(); ++i) {
    const uint64_t texture_seed = Random(seed, RandomStream::kTexture, i).Next();
    scene.materials.push_back(BackgroundMaterial(random, texture_seed));
  }
  Furnish(scene, options.furniture, seed);
  AddSolids(solids, random, seed, scene);
  if (options.wire_like_background) PaintAs(scene.materials[kWall], scene.materials[0]);
  scene.lighting = MakeLighting(options.light, seed);
  return scene;
}

}  // namespace curvefusion
