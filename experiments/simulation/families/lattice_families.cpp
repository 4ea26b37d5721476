// Families whose wires cross on surfaces: cages, grids, trolleys, chairs, nets.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/simulation/families/family_makers.h"
#include "experiments/simulation/families/wire_shapes.h"

namespace curvefusion {
namespace {

constexpr double kPi = std::numbers::pi;

// Neighbours' axes at least 8 mm apart, and a gap as wide as the wire between them.
double Spacing(Random& random, double diameter, double low, double high) {
  const double least = std::max({8.0, 2 * diameter, low});
  return random.LogUniform(least, std::max(high, least));
}

int CountOf(double length, double spacing, int least, int most) {
  return std::clamp(static_cast<int>(length / spacing), least, most);
}

// A bend of a flat thing: around the vertical, sagging, or twisted.
std::function<Vec3(const Vec3&)> DrawnBend(Random& random, double size) {
  const double curl = random.Chance(0.5) ? random.Uniform(-0.5, 0.5) / size : 0;  // 1/mm
  const double sag = random.Uniform(0, 0.25) / size;
  const double twist = random.Uniform(-0.5, 0.5) / size;  // radians a mm
  return [=](const Vec3& p) -> Vec3 {
    const double angle = p.x() * curl;
    const double x = curl == 0 ? p.x() : std::sin(angle) / curl;
    const double y = p.y() + (curl == 0 ? 0 : (1 - std::cos(angle)) / curl);
    const double turn = twist * p.z();
    return {x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn),
            p.z() - sag * p.x() * p.x()};
  };
}

}  // namespace

// Bars around, hoops, and a dome or none.
void MakeCage(Random& random, WireAssembly& wires) {
  const double radius = random.LogUniform(70, 190);
  const double height = std::min(radius * random.Uniform(1.2, 2.8), 500.0);
  const double flattening = random.Uniform(0.6, 1);
  const double bulge = random.Uniform(-0.25, 0.35);
  const double bar = random.LogUniform(2.5, 5);
  const double hoop = random.LogUniform(std::max(bar, 3.0), 8);
  const double round = 2 * kPi * radius * flattening * (1 - std::max(-bulge, 0.0));
  const int bars = CountOf(round, Spacing(random, bar, 14, 60), 6, 40);
  const int hoops = random.Integer(2, 5);
  const int dome = random.Chance(0.6) ? 3 : 0;
  // The crown is as wide as its bars need.
  const double crown = bars * std::max(9.0, 2.2 * bar) / (2 * kPi * flattening);
  const double rise = dome > 0 ? std::max(radius * random.Uniform(0.5, 1.1), 40.0) : 0;
  const int body = hoops - 1;
  const Lattice lattice(bars, body + dome, true, [&](double u, double v) -> Vec3 {
    const double angle = 2 * kPi * u / bars;
    const double low = std::min(v / body, 1.0);
    const double high = dome > 0 ? std::max(v - body, 0.0) / dome * kPi / 2 : 0;
    const double wide = radius * (1 + bulge * std::sin(kPi * low));
    const double r = crown < wide ? crown + (wide - crown) * std::cos(high) : wide;
    return {r * std::cos(angle), flattening * r * std::sin(angle),
            height * low + rise * std::sin(high)};
  });
  for (int k = 0; k < hoops; ++k) wires.AddLoop(lattice.Row(k), hoop);
  if (dome > 0) wires.AddLoop(lattice.Row(body + dome), hoop);
  for (int i = 0; i < bars; ++i) wires.Add(lattice.Column(i), bar);
}

// Wires both ways, framed or not, flat or bent, spacing even or growing.
void MakeGrid(Random& random, WireAssembly& wires) {
  const double thin = random.LogUniform(2.5, 5.5);
  const double thick = random.LogUniform(thin, 9);
  const double across = Spacing(random, thin, 8, 50);
  const double upward = Spacing(random, thin, 8, 60);
  constexpr int kMost = 28;
  const int columns = CountOf(random.LogUniform(160, 550), across, 4, kMost);
  const int rows = CountOf(random.LogUniform(160, 450), upward, 3, kMost);
  const double grading = random.Uniform(0, 0.6);  // the last cell is so much wider
  const bool framed = random.Chance(0.5);
  const int inner = framed || random.Chance(0.5) ? 1 : 0;  // without a frame: ends stand out
  const double width = columns * across * (1 + grading / 2), height = rows * upward;
  const Lattice lattice(columns, rows, false, [&](double u, double v) -> Vec3 {
    return {across * u * (1 + grading * u / (2 * columns)) - width / 2, 0, upward * v};
  });
  for (int i = inner; i <= columns - inner; ++i) wires.Add(lattice.Column(i), thin);
  for (int k = inner; k <= rows - inner; ++k) wires.Add(lattice.Row(k), thin);
  if (framed) {
    wires.Add(lattice.Row(0), thick);
    wires.Add(lattice.Row(rows), thick);
    wires.Add(lattice.Column(0), thick);
    wires.Add(lattice.Column(columns), thick);
  }
  wires.Warp(DrawnBend(random, std::max(width, height)));
}

// A basket of wires on four posts with wheels, and a handle.
void MakeTrolley(Random& random, WireAssembly& wires) {
  const double thin = random.LogUniform(2.5, 4.5);
  const double thick = random.LogUniform(std::max(thin, 4.0), 10);
  const double spacing = Spacing(random, thin, 8, 45);
  constexpr int kMost = 14;
  const double width = random.LogUniform(160, 420), depth = width * random.Uniform(0.5, 0.9);
  const int nx = CountOf(width, spacing, 3, kMost), ny = CountOf(depth, spacing, 2, kMost);
  const double high = random.LogUniform(80, 220);
  const int rings = CountOf(high, std::max(spacing, 25.0), 1, 6);
  const double slant = random.Uniform(0, 0.3);  // by which the bottom is narrower
  const auto box = [&](double x, double y, double level) -> Vec3 {
    const double scale = 1 - slant * (1 - level);
    return {scale * width * (x / nx - 0.5), scale * depth * (y / ny - 0.5), high * level};
  };
  const auto around = [&](double u) {  // along the four sides
    if (u <= nx) return Vec2(u, 0);
    if (u <= nx + ny) return Vec2(nx, u - nx);
    return u <= 2 * nx + ny ? Vec2(2 * nx + ny - u, ny) : Vec2(0, 2 * (nx + ny) - u);
  };
  const int posts = 2 * (nx + ny);
  const Lattice walls(posts, rings, true, [&](double u, double v) {
    const Vec2 side = around(u);
    return box(side.x(), side.y(), v / rings);
  });
  for (int k = 0; k <= rings; ++k) wires.AddLoop(walls.Row(k), k == rings ? thick : thin);
  for (int i = 0; i < posts; ++i) wires.Add(walls.Column(i), thin);
  const Lattice floor(nx, ny, false, [&](double u, double v) { return box(u, v, 0); });
  for (int i = 1; i < nx; ++i) wires.Add(floor.Column(i), thin);
  if (random.Chance(0.6)) {
    for (int k = 1; k < ny; ++k) wires.Add(floor.Row(k), thin);
  }
  const double legs = random.LogUniform(80, 300), wheel = random.Uniform(20, 35);
  const double splay = random.Uniform(0, 0.2);
  for (const int x : {0, nx}) {
    for (const int y : {0, ny}) {
      const Vec3 top = floor.At(x, y);
      const Vec3 foot = top + Vec3(splay * top.x(), splay * top.y(), -legs);
      wires.Add(Straight(top, foot), thick);
      Polyline rim;
      for (int i = 0; i < 24; ++i) {
        const double angle = 2 * kPi * i / 24;
        rim.push_back(foot + wheel * Vec3(std::sin(angle), 0, std::cos(angle) - 1));
      }
      wires.AddLoop(rim, std::min(thick, 6.0));
    }
  }
  const double back = random.Uniform(40, 120);
  const Vec3 left = box(0, ny, 1), right = box(nx, ny, 1);
  const Vec3 out(0, 0.5 * back, back);
  wires.Add(SmoothThrough({left, left + 0.6 * out, left + out + Vec3(15, 0, 0),
                           right + out - Vec3(15, 0, 0), right + 0.6 * out, right}),
            thick);
}

// A seat of wires on four legs, a back with uprights, armrests or none.
void MakeChair(Random& random, WireAssembly& wires) {
  const double thin = random.LogUniform(2.5, 5);
  const double thick = random.LogUniform(std::max(thin, 5.0), 12);
  const double width = random.LogUniform(140, 400), depth = width * random.Uniform(0.8, 1.1);
  const double seat = width * random.Uniform(0.7, 1.1), back = width * random.Uniform(0.7, 1.1);
  const double sag = random.Uniform(0, 0.12) * width, lean = random.Uniform(0.1, 0.35);
  const double arch = random.Uniform(0, 0.3) * width, curl = random.Uniform(0, 0.25) * width;
  constexpr int kMost = 22;
  const int columns = CountOf(width, Spacing(random, thin, 8, 60), 3, kMost);
  const int rows = CountOf(depth, Spacing(random, thin, 8, 60), 2, kMost);
  const auto hump = [&](double u) { return 4 * u / columns * (1 - u / columns); };
  const Lattice plane(columns, rows, false, [&](double u, double v) -> Vec3 {
    const double dip = 4 * v / rows * (1 - v / rows) * hump(u);
    return {width * (u / columns - 0.5), depth * (v / rows - 0.5), seat - sag * dip};
  });
  constexpr int kBackRows = 3;
  const Lattice rest(columns, kBackRows, false, [&](double u, double v) -> Vec3 {
    const double t = v / kBackRows;
    return {width * (u / columns - 0.5), depth / 2 + t * (lean * back + curl * hump(u)),
            seat + t * (back + arch * hump(u))};
  });
  const bool crossed = random.Chance(0.6);
  for (int i = 0; i <= columns; ++i) {
    wires.Add(plane.Column(i), i == 0 || i == columns ? thick : thin);
    wires.Add(rest.Column(i), i == 0 || i == columns ? thick : thin);
  }
  for (int k = 0; k <= rows; ++k) {
    const bool edge = k == 0 || k == rows;
    if (edge || crossed) wires.Add(plane.Row(k), edge ? thick : thin);
  }
  wires.Add(rest.Row(kBackRows), thick);
  if (random.Chance(0.5)) wires.Add(rest.Row(1), thin);
  const double splay = random.Uniform(0, 0.15);
  for (const int x : {0, columns}) {
    for (const int y : {0, rows}) {
      const Vec3 top = plane.At(x, y);
      wires.Add(Straight(top, Vec3(top.x() * (1 + splay), top.y() * (1 + splay), 0)), thick);
    }
    if (!random.Chance(0.4)) continue;
    const Vec3 rear = rest.At(x, 2), front = plane.At(x, 0);
    wires.Add(SmoothThrough({rear, Vec3(front.x() * 1.15, 0, rear.z()),
                             Vec3(front.x() * 1.1, front.y() * 0.9, rear.z() - 15), front}),
              thick);
  }
}

// Meshes that stand on a corner, knotted at jittered nodes, in a border, hung or bulging.
void MakeNet(Random& random, WireAssembly& wires) {
  const double thin = random.LogUniform(2.5, 4.5), border = random.LogUniform(thin, 8);
  const double cell = Spacing(random, 1.5 * thin, 16, 60);  // half a mesh's diagonal
  const int nx = 2 * CountOf(random.LogUniform(160, 500), 2 * cell, 3, 10);
  const int ny = 2 * CountOf(random.LogUniform(160, 400), 2 * cell, 3, 8);
  const double loose = random.Uniform(0, 0.2) * cell;
  const double hang = random.Uniform(-0.4, 0.4) / (nx * cell), bow = random.Uniform(0, 0.5);
  std::vector<Vec3> nodes((nx + 1) * (ny + 1));
  const auto node = [&](int i, int j) -> Vec3& { return nodes[j * (nx + 1) + i]; };
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) {
      const bool inside = i > 0 && i < nx && j > 0 && j < ny;
      const double jitter = inside ? loose : 0;
      const double x = cell * (i - nx / 2.0) + jitter * random.Uniform(-1, 1);
      const double z = cell * j + jitter * random.Uniform(-1, 1);
      const double high = z / (ny * cell);
      node(i, j) = Vec3(x, bow * cell * ny * high * (1 - high) + jitter * random.Uniform(-1, 1),
                        z - hang * x * x);
    }
  }
  for (const int lean : {1, -1}) {
    for (int start = -ny; start <= nx; start += 2) {
      Polyline knots;
      for (int j = 0; j <= ny; ++j) {
        const int i = lean > 0 ? start + j : nx - start - j;
        if (i >= 0 && i <= nx) knots.push_back(node(i, j));
      }
      if (knots.size() > 1) wires.Add(SmoothThrough(knots), thin);
    }
  }
  Polyline rope;
  for (int i = 0; i < nx; ++i) rope.push_back(node(i, 0));
  for (int j = 0; j < ny; ++j) rope.push_back(node(nx, j));
  for (int i = nx; i > 0; --i) rope.push_back(node(i, ny));
  for (int j = ny; j > 0; --j) rope.push_back(node(0, j));
  wires.AddLoop(rope, border);
}

}  // namespace curvefusion
