// Draws tubes close up, shaded with the normals that GLB files carry: smooth along the wires,
// broken at seams. Usage: tubes_picture FILE.png
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "experiments/pictures/png.h"
#include "kernel/image.h"
#include "meshing/surface_mesh.h"
#include "meshing/tube_normals.h"
#include "meshing/tubes.h"
#include "tests/meshing/tube_graphs.h"

namespace curvefusion {
namespace {

constexpr int kPanel = 440;      // pixels, of one picture
constexpr int kSupersample = 3;  // per axis

// What is drawn: a square of this width about a point, seen along a direction.
struct View {
  Vec3 centre;
  double width;
  Vec3 towards_viewer;
};

struct Canvas {
  Image<double> depth;
  Image<double> brightness;
};

// Light from the upper left of the viewer; x right, y up, z towards the viewer.
double Shade(const Vec3& normal) {
  const Vec3 light = Vec3(-0.4, 0.6, 0.7).normalized();
  const Vec3 half = (light + Vec3::UnitZ()).normalized();
  const double diffuse = std::max(0.0, normal.dot(light));
  return 0.18 + 0.62 * diffuse + 0.2 * std::pow(std::max(0.0, normal.dot(half)), 40);
}

// Draws a triangle of canvas points (z = depth) with a normal at every corner.
void DrawTriangle(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& normals,
                  Canvas& canvas) {
  const Vec3 low = p[0].cwiseMin(p[1]).cwiseMin(p[2]).cwiseMax(0);
  const Vec3 high = p[0].cwiseMax(p[1]).cwiseMax(p[2]).cwiseMin(kPanel * kSupersample - 1);
  const auto cross = [](const Vec3& a, const Vec3& b, double x, double y) {
    return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
  };
  const double area = cross(p[0], p[1], p[2].x(), p[2].y());
  if (area == 0) return;
  for (int y = static_cast<int>(std::ceil(low.y())); y <= high.y(); ++y) {
    for (int x = static_cast<int>(std::ceil(low.x())); x <= high.x(); ++x) {
      const double a = cross(p[1], p[2], x, y) / area;
      const double b = cross(p[2], p[0], x, y) / area;
      const double c = 1 - a - b;
      if (a < 0 || b < 0 || c < 0) continue;
      const double depth = a * p[0].z() + b * p[1].z() + c * p[2].z();
      if (depth <= canvas.depth(x, y)) continue;
      canvas.depth(x, y) = depth;
      canvas.brightness(x, y) =
          Shade((a * normals[0] + b * normals[1] + c * normals[2]).normalized());
    }
  }
}

Canvas Draw(const TubeMesh& tubes, const View& view) {
  const TriangleMesh mesh = ToTriangleMesh(tubes.surface);
  const int size = kPanel * kSupersample;
  Canvas canvas{Image<double>(size, size, -std::numeric_limits<double>::infinity()),
                Image<double>(size, size, 1.0)};
  Mat3 axes;
  axes.row(2) = view.towards_viewer.normalized();
  axes.row(0) = Vec3::UnitZ().cross(view.towards_viewer).normalized();
  axes.row(1) = axes.row(2).cross(axes.row(0));
  const double scale = size / view.width;
  const CornerNormals normals = ComputeTubeNormals(mesh, tubes.paths);
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    std::array<Vec3, 3> points;
    std::array<Vec3, 3> corners;
    for (int k = 0; k < 3; ++k) {
      const Vec3 p =
          axes * (mesh.vertices[mesh.triangles[face][k]].cast<double>() - view.centre) * scale;
      points[k] = {size / 2.0 + p.x(), size / 2.0 - p.y(), p.z()};
      corners[k] = axes * normals.normals[normals.of_corner[face][k]].cast<double>();
    }
    DrawTriangle(points, corners, canvas);
  }
  return canvas;
}

// Copies a canvas, averaged over its samples, into the panel whose corner is at (u, v).
void CopyPanel(const Canvas& canvas, int u, int v, ColorImage& picture) {
  for (int y = 0; y < kPanel; ++y) {
    for (int x = 0; x < kPanel; ++x) {
      double sum = 0;
      for (int k = 0; k < kSupersample * kSupersample; ++k) {
        sum += canvas.brightness(kSupersample * x + k % kSupersample,
                                 kSupersample * y + k / kSupersample);
      }
      const double mean = std::min(1.0, sum / (kSupersample * kSupersample));
      picture(u + x, v + y).fill(static_cast<uint8_t>(std::lround(255 * mean)));
    }
  }
}

SkeletonGraph StarOfEight() {
  std::vector<Vec3> directions;
  for (int i = 0; i < 8; ++i) {
    const double angle = 2 * std::numbers::pi * i / 8;
    directions.emplace_back(std::cos(angle), std::sin(angle), 0.3 * (i % 2));
  }
  return StarGraph(directions, 0.05, 0.003);
}

SkeletonGraph RadiusJump() {
  SkeletonGraph graph = StarGraph({{1, 0, 0}, {-1, 0.1, 0}, {0, 1, 0}}, 0.06, 0.002);
  SetRadius(graph, 0, 0.008, 0.008);
  return graph;
}

void DrawAll(const char* path) {
  ColorImage picture(2 * kPanel, 2 * kPanel);
  int panel = 0;
  const auto draw = [&](const SkeletonGraph& graph, const View& view) {
    CopyPanel(Draw(BuildTubes(graph, {}), view), kPanel * (panel % 2), kPanel * (panel / 2),
              picture);
    ++panel;
  };
  const SkeletonGraph cage = CageGraph();
  const SkeletonGraph chair = ChairGraph();
  const auto middle = [](const SkeletonGraph& graph) {
    return graph.position(graph.Nodes()[graph.Nodes().size() / 2]);
  };
  draw(cage, {middle(cage), 0.08, {0.3, -1, 0.6}});
  draw(chair, {middle(chair), 0.08, {0.3, -0.5, 1}});
  draw(StarOfEight(), {Vec3::Zero(), 0.04, {0.2, -0.5, 1}});
  draw(RadiusJump(), {Vec3::Zero(), 0.05, {0.4, -0.6, 1}});
  WritePng(path, picture);
}

}  // namespace
}  // namespace curvefusion

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "Usage: tubes_picture FILE.png\n");
    return 2;
  }
  curvefusion::DrawAll(argv[1]);
  return 0;
}
