#include "experiments/simulation/furniture_makers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace curvefusion {
namespace {

constexpr double kPi = std::numbers::pi;

SceneBox Cuboid(const Vec3& center, const Vec3& half_size, int material, double yaw = 0) {
  SceneBox box;
  box.center = center;
  box.half_size = half_size;
  box.rotation = Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix();
  box.material = material;
  return box;
}

// Upright, from a base; open at the top where it has a wall.
SceneBox Cylinder(const Vec3& base, double radius, double height, double wall, int material) {
  SceneBox box;
  box.shape = BoxShape::kCylinder;
  box.half_size = {radius, radius, height / 2};
  box.center = base + Vec3(0, 0, height / 2);
  box.wall = wall;
  box.material = material;
  return box;
}

Thing BookStack(Random& random, const Palette& palette) {
  Thing stack;
  const int books = random.Integer(1, 6);
  for (int i = 0; i < books; ++i) {
    const double thick = random.Uniform(0.008, 0.04);
    const Vec3 half(random.Uniform(0.06, 0.1), random.Uniform(0.08, 0.13), thick / 2);
    stack.boxes.push_back(
        Cuboid({random.Uniform(-0.01, 0.01), random.Uniform(-0.01, 0.01), stack.height + thick / 2},
               half, palette.Draw(random), random.Uniform(-0.3, 0.3)));
    stack.height += thick;
  }
  stack.radius = 0.17;
  return stack;
}

// Upright side by side along x, their spines towards -y, some leaning.
void AddBookRow(Random& random, const Palette& palette, const Vec3& start, double length,
                double deepest, Thing& row) {
  double x = 0;
  while (true) {
    const double thick = random.Uniform(0.01, 0.045), high = random.Uniform(0.14, 0.26);
    const double deep = random.Uniform(0.7, 1) * deepest;
    const double lean = random.Chance(0.2) ? random.Uniform(0, 0.25) : 0;
    x += thick + high * std::sin(lean);
    if (x > length) return;
    SceneBox book = Cuboid(start + Vec3(x - thick / 2 - high / 2 * std::sin(lean), deep / 2,
                                        high / 2 * std::cos(lean) + thick / 2 * std::sin(lean)),
                           {thick / 2, deep / 2, high / 2}, palette.Draw(random));
    book.rotation = Eigen::AngleAxisd(-lean, Vec3::UnitY()).toRotationMatrix();
    row.boxes.push_back(book);
    row.height = std::max(row.height, start.z() + high);
  }
}

Thing BookRow(Random& random, const Palette& palette) {
  Thing row;
  const double length = random.Uniform(0.1, 0.3);
  AddBookRow(random, palette, {-length / 2, -0.09, 0}, length, 0.18, row);
  row.radius = std::hypot(length / 2, 0.1);
  row.faces_front = true;
  return row;
}

// With a handle of 14 to 18 mm: thicker than any wire.
Thing Cup(Random& random, const Palette& palette) {
  Thing cup;
  const double radius = random.Uniform(0.032, 0.05), high = random.Uniform(0.07, 0.11);
  const int material = palette.Draw(random);
  cup.boxes.push_back(Cylinder(Vec3::Zero(), radius, high, random.Uniform(0.003, 0.006), material));
  if (random.Chance(0.4)) {  // a saucer
    cup.boxes.push_back(
        Cylinder(Vec3::Zero(), random.Uniform(1.5, 1.9) * radius, 0.008, 0, material));
  }
  const double thick = random.Uniform(0.007, 0.009), wide = random.Uniform(0.6, 0.9) * radius;
  constexpr int kPieces = 8;
  const auto at = [&](int k) -> Vec3 {
    const double t = kPi * k / kPieces;
    return {radius + wide * std::sin(t) - 0.5 * thick, 0, high * (0.5 + 0.3 * std::cos(t))};
  };
  for (int k = 0; k < kPieces; ++k) cup.capsules.push_back({at(k), at(k + 1), thick, material});
  cup.radius = 2 * radius;
  cup.height = high;
  return cup;
}

Thing Bottle(Random& random, const Palette& palette) {
  Thing bottle;
  const double radius = random.Uniform(0.03, 0.05), high = random.Uniform(0.1, 0.2);
  const int material = palette.Draw(random);
  bottle.boxes.push_back(Cylinder(Vec3::Zero(), radius, high, 0, material));
  const double neck = random.Uniform(0.016, 0.5 * radius + 0.003);
  bottle.boxes.push_back(
      Cylinder({0, 0, high}, neck, random.Uniform(0.03, 0.08), 0, palette.Draw(random)));
  SceneBox shoulder = Cuboid({0, 0, high}, {radius, radius, 0.6 * radius}, material);
  shoulder.shape = BoxShape::kEllipsoid;
  bottle.boxes.push_back(shoulder);
  bottle.radius = radius;
  bottle.height = high + 0.08;
  return bottle;
}

Thing Monitor(Random& random, const Palette& palette) {
  Thing monitor;
  const Vec3 half(random.Uniform(0.14, 0.26), random.Uniform(0.007, 0.02),
                  random.Uniform(0.09, 0.16));
  const double foot = random.Uniform(0.05, 0.12);
  const int material = palette.Draw(random);
  monitor.boxes.push_back(Cuboid({0, 0, foot + half.z()}, half, material));
  monitor.boxes.push_back(Cuboid({0, -half.y() - 0.001, foot + half.z()},
                                 {half.x() - 0.012, 0.001, half.z() - 0.012},
                                 palette.Draw(random)));
  monitor.boxes.push_back(
      Cuboid({0, 0.02, foot / 2 + 0.01}, {0.025, 0.01, foot / 2 + 0.02}, material));
  monitor.boxes.push_back(Cuboid({0, 0.02, 0.006}, {0.1, 0.08, 0.006}, material));
  monitor.radius = half.x();
  monitor.height = foot + 2 * half.z();
  monitor.faces_front = true;
  return monitor;
}

// Four posts and slats of 12 to 35 mm on two sides, as crates and chairs' backs have them.
Thing Slats(Random& random, const Palette& palette) {
  Thing crate;
  const double wide = random.Uniform(0.1, 0.2), deep = random.Uniform(0.06, 0.14);
  const double high = random.Uniform(0.12, 0.32), post = random.Uniform(0.008, 0.015);
  const int material = palette.Draw(random), slats = random.Integer(2, 6);
  const double half = std::min(random.Uniform(0.006, 0.018), 0.35 * high / slats);
  const double thick = random.Uniform(0.003, 0.006);
  const bool upright = random.Chance(0.4);
  for (const double y : {-deep, deep}) {
    for (const double x : {-wide, wide}) {
      crate.boxes.push_back(Cuboid({x, y, high / 2}, {post, post, high / 2}, material));
    }
    for (int i = 0; i < slats; ++i) {
      const double share = (i + 0.5) / slats;
      crate.boxes.push_back(
          upright ? Cuboid({wide * (2 * share - 1), y, high / 2}, {half, thick, high / 2}, material)
                  : Cuboid({0, y, high * share}, {wide, thick, half}, material));
    }
    if (!upright) continue;
    for (const double z : {0.1, 0.9}) {
      crate.boxes.push_back(Cuboid({0, y, high * z}, {wide, thick, 0.01}, material));
    }
  }
  crate.radius = std::hypot(wide, deep) + post;
  crate.height = high;
  return crate;
}

// Leaves are flat ellipsoids on stems of 14 to 20 mm.
Thing Plant(Random& random, const Palette& palette) {
  Thing plant;
  const double pot = random.Uniform(0.04, 0.07), rim = random.Uniform(0.07, 0.11);
  plant.boxes.push_back(Cylinder(Vec3::Zero(), pot, rim, 0.008, palette.Draw(random)));
  const int material = palette.Draw(random);
  const double stem = random.Uniform(0.007, 0.01), high = rim + random.Uniform(0.05, 0.18);
  plant.capsules.push_back({{0, 0, 0.02}, {0, 0, high}, stem, material});
  const int leaves = random.Integer(8, 22);
  for (int i = 0; i < leaves; ++i) {
    const double azimuth = 2.4 * i, length = random.Uniform(0.03, 0.07);
    const double rise = random.Uniform(-0.5, 1.1);
    const Vec3 out(std::cos(rise) * std::cos(azimuth), std::cos(rise) * std::sin(azimuth),
                   std::sin(rise));
    const double z = rim + (high - rim) * (i + 1.0) / leaves;
    SceneBox leaf = Cuboid(Vec3(0, 0, z) + (length + 0.5 * stem) * out,
                           {length, random.Uniform(0.3, 0.55) * length, 0.001}, material);
    leaf.shape = BoxShape::kEllipsoid;
    leaf.rotation.col(0) = out;
    leaf.rotation.col(1) = Vec3(-std::sin(azimuth), std::cos(azimuth), 0);
    leaf.rotation.col(2) = leaf.rotation.col(0).cross(leaf.rotation.col(1));
    plant.boxes.push_back(leaf);
  }
  plant.radius = pot + 0.05;
  plant.height = high + 0.1;
  return plant;
}

}  // namespace

Thing MakeTableThing(Random& random, const Palette& palette) {
  static constexpr Thing (*kMakers[])(Random&, const Palette&) = {BookStack, BookRow, Cup,   Cup,
                                                                  Bottle,    Monitor, Slats, Plant};
  return kMakers[random.Next() % std::size(kMakers)](random, palette);
}

Thing MakeShelf(Random& random, const Palette& palette) {
  Thing shelf;
  const double wide = random.Uniform(0.15, 0.4), deep = random.Uniform(0.12, 0.2);
  const double thick = random.Uniform(0.008, 0.012);
  shelf.boxes.push_back(Cuboid({0, -deep / 2, 0}, {wide, deep / 2, thick}, palette.Draw(random)));
  const double books = random.Uniform(0.3, 0.9) * wide;
  AddBookRow(random, palette, {-wide + 0.02, -deep + 0.01, thick}, 2 * books, deep - 0.02, shelf);
  const Thing cup = Cup(random, palette);
  const double x = -wide + 0.02 + 2 * books + cup.radius;
  if (x + cup.radius < wide) {
    for (SceneBox box : cup.boxes) {
      box.center += Vec3(x, -deep / 2, thick);
      shelf.boxes.push_back(box);
    }
    for (SceneCapsule handle : cup.capsules) {
      handle.start += Vec3(x, -deep / 2, thick);
      handle.end += Vec3(x, -deep / 2, thick);
      shelf.capsules.push_back(handle);
    }
  }
  shelf.radius = wide;
  return shelf;
}

Thing MakeDoor(Random& random, const Palette& palette) {
  Thing door;
  const double wide = random.Uniform(0.12, 0.25), high = random.Uniform(0.4, 0.7);
  const double deep = random.Uniform(0.02, 0.12);
  const int material = palette.Draw(random), metal = palette.Draw(random);
  const double knob = random.Uniform(0.009, 0.016), out = random.Uniform(0.02, 0.035);
  for (const double side : {-1.0, 1.0}) {
    const double x = side * wide / 2;
    door.boxes.push_back(
        Cuboid({x, -deep / 2, high / 2}, {wide / 2 - 0.003, deep / 2, high / 2}, material));
    const Vec3 at(0.35 * x, -deep, random.Uniform(0.4, 0.6) * high);
    door.capsules.push_back({at, at - Vec3(0, out, 0), knob, metal});
  }
  door.radius = wide;
  return door;
}

Thing MakeArm(Random& random, const Palette& palette) {
  Thing arm;
  const int skin = palette.Draw(random), sleeve = palette.Draw(random);
  const double spread = random.Uniform(0.008, 0.014);
  for (int finger = 0; finger < 4; ++finger) {
    const double y = (finger - 1.5) * (0.02 + spread / 2), length = finger == 1 ? 0.09 : 0.075;
    arm.capsules.push_back({{0.09 - length, y * 1.3, 0.01}, {0.1, y, 0.02}, 0.008, skin});
  }
  arm.capsules.push_back({{0.06, -0.06, 0}, {0.13, -0.025, 0.015}, 0.01, skin});  // the thumb
  SceneBox palm = Cuboid({0.14, 0, 0.02}, {0.055, 0.042, 0.016}, skin);
  palm.shape = BoxShape::kEllipsoid;
  arm.boxes.push_back(palm);
  const Vec3 elbow(0.42, random.Uniform(-0.05, 0.05), random.Uniform(-0.05, 0.1));
  arm.capsules.push_back({{0.18, 0, 0.02}, 0.5 * (elbow + Vec3(0.18, 0, 0.02)), 0.028, skin});
  arm.capsules.push_back({0.5 * (elbow + Vec3(0.18, 0, 0.02)), elbow, 0.042, sleeve});
  arm.capsules.push_back({elbow, elbow + Vec3(0.25, random.Uniform(0, 0.1), 0.1), 0.05, sleeve});
  arm.height = 0.1;
  return arm;
}

}  // namespace curvefusion
