#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "experiments/simulation/lighting.h"
#include "experiments/simulation/objects.h"
#include "kernel/geometry.h"
#include "kernel/options.h"

namespace curvefusion {

/// How a surface looks, to the colour camera and to infrared light.
struct SurfaceMaterial {
  Vec3 color = Vec3::Constant(0.5);  ///< diffuse reflectance in red, green and blue, 0 to 1
  double texture_contrast = 0;       ///< share by which the texture varies the colour
  uint64_t texture_seed = 0;
  double infrared_albedo = 0.6;  ///< diffuse reflectance of the projector's light, 0 to 1
  double shininess = 0;          ///< share of the light that is mirrored instead of scattered
};

/// A cylinder with half-balls at its ends: a straight piece of wire.
struct SceneCapsule {
  Vec3 start;
  Vec3 end;
  double radius;
  int material = 0;  ///< index into Scene::materials; 0 is the wires'
};

/// The points with normal . p = offset; the scene lies on the side the normal points to.
struct ScenePlane {
  Vec3 normal;
  double offset;
};

/// What of a box is filled.
enum class BoxShape {
  kBox,
  kEllipsoid,  ///< the inscribed one
  kCylinder    ///< about its z axis, as wide as its x: solid, or open at the top with a wall
};

/// A box, or what is inscribed in it.
struct SceneBox {
  Vec3 center;
  Vec3 half_size;
  Mat3 rotation = Mat3::Identity();  ///< columns: its axes in the world
  BoxShape shape = BoxShape::kBox;
  double wall = 0;   ///< of a cylinder that is open at the top; 0 = solid
  int material = 0;  ///< index into Scene::materials
};

/// What stands before the camera, in the world frame: z up, the object's bounding box centred at
/// the origin, the camera on the side of -y, a wall on the side of +y.
struct Scene {
  WireObject object;
  Eigen::AlignedBox3d object_bounds;
  std::vector<SceneCapsule> capsules;
  std::vector<ScenePlane> planes;
  std::vector<SceneBox> boxes;
  std::vector<SurfaceMaterial> materials;  ///< of the wires, of each plane, of other things
  Lighting lighting;                       ///< for the colour camera

  double TableHeight() const { return planes.front().offset; }
};

/// What of the scene is chosen; the rest is drawn from the seed.
struct SceneOptions {
  double wire_albedo = 0.7;      ///< 0 to 1; black is .05, white .9
  double wire_hue = 0.35;        ///< 0 to 1, red through green and blue to red
  double wire_saturation = 0.6;  ///< 0 (grey) to 1
  double wire_shininess = 0;     ///< 0 (matt) to 1 (mirror)
  int furniture = 0;             ///< things that are no wires (furniture.h), beside the boxes
  /// 0 to 1 for the projector's light; below 0 it is wire_albedo. A black wire whose lacquer is
  /// bright in infrared: wire_albedo .05 and this .6.
  double wire_infrared_albedo = -1;
  bool wire_like_background = false;  ///< the colour and texture of the wall behind, whatever else
  LightKind light = LightKind::kLamp;
  /// Metres between the object's lowest point and the table, 0 where it lies on it; drawn from 0.06
  /// to 0.10 where there is none.
  std::optional<double> table_gap = {};
};

void VisitOptions(SceneOptions& options, OptionVisitor& visitor);

/// A room with a table 60 to 100 mm below the object unless the options say where, a wall 0.4 to
/// 0.6 m behind it, walls to both sides and 3 to 5 boxes on the table that neither touch the object
/// nor stand in front of it. Objects flatter than a third of their width are stood up, as one would
/// hang them to scan them. An object without curves gets the room of one of 0.3 m. Furniture stands
/// around the object and hangs on the wall. The same seed gives the same scene, and with more
/// furniture the same room.
Scene MakeScene(const WireObject& object, const SceneOptions& options, uint64_t seed);

}  // namespace curvefusion
