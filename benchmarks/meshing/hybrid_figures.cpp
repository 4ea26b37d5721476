// Compares a closed mesh with the true surface, and draws both from the front, the side and above.
// Usage: hybrid_figures MESH TRUE_MESH FILE.png
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "experiments/metrics/curve_metrics.h"
#include "experiments/pictures/mesh_view.h"
#include "experiments/pictures/png.h"
#include "meshing/io/mesh_io.h"
#include "meshing/watertight.h"

namespace curvefusion {
namespace {

constexpr double kStep = 1 * kMillimetre;
constexpr int kPanel = 420;

// Points about a step apart, each of which stands for as much area as the others of its triangle.
struct Samples {
  std::vector<Vec3> positions;
  std::vector<double> areas;
};

Samples SamplesOf(const TriangleMesh& mesh) {
  Samples samples;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 a = mesh.vertices[i].cast<double>();
    const Vec3 u = mesh.vertices[j].cast<double>() - a, v = mesh.vertices[k].cast<double>() - a;
    const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
    const int n = std::max(1, static_cast<int>(std::ceil(longest / kStep)));
    const double area = u.cross(v).norm() / 2 / (n * n);
    for (int row = 0; row < n; ++row) {
      for (int column = 0; column < 2 * (n - row) - 1; ++column) {
        const double shift = column % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
        samples.positions.push_back(a + (row + shift) / n * u + (column / 2 + shift) / n * v);
        samples.areas.push_back(area);
      }
    }
  }
  return samples;
}

void Print(const char* what, const Samples& from, const Samples& to) {
  const std::vector<double> distances = DistancesTo(from.positions, to.positions);
  double sum = 0, area = 0;
  for (size_t i = 0; i < distances.size(); ++i) {
    sum += from.areas[i] * distances[i];
    area += from.areas[i];
  }
  fmt::print("{:<13} 5 mm {:.3f}  10 mm {:.3f}  mean {:.2f} mm\n", what,
             ShareWithin(distances, from.areas, 0.005).value_or(0),
             ShareWithin(distances, from.areas, 0.010).value_or(0), 1000 * sum / area);
}

void Print(const char* what, const TriangleMesh& mesh) {
  const WatertightReport report = ExamineMesh(mesh);
  fmt::print("{:<6} watertight {}  pieces {}  genus {}  volume {:.1f} cm3  area {:.0f} cm2\n", what,
             report.IsWatertight() ? "yes" : "NO", report.components, report.genus,
             1e6 * report.volume, 1e4 * report.area);
}

ColorImage Drawn(const TriangleMesh& mesh, const TriangleMesh& truth) {
  ColorImage picture(3 * kPanel, kPanel);
  Mat3 front, side, above;
  front << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const double turn = 0.7, tilt = 0.35;
  side = Eigen::AngleAxisd(tilt, Vec3::UnitX()) * front *
         Eigen::AngleAxisd(-turn, Vec3::UnitZ()).toRotationMatrix();
  above = Eigen::AngleAxisd(2.2, Vec3::UnitX()).toRotationMatrix() *
          Eigen::AngleAxisd(std::acos(-1.0) + turn, Vec3::UnitZ()).toRotationMatrix();
  const Mat3 views[] = {front, side, above};
  for (int i = 0; i < 3; ++i) {
    Eigen::AlignedBox3d bounds;
    for (const Vec3f& v : truth.vertices) bounds.extend(views[i] * v.cast<double>());
    const double scale = 0.8 * kPanel / bounds.sizes().head<2>().maxCoeff();
    const ColorImage panel =
        DrawMesh(mesh, {.R_view_world = views[i]}, bounds, kPanel, kPanel, scale);
    for (int y = 0; y < kPanel; ++y) {
      for (int x = 0; x < kPanel; ++x) picture(i * kPanel + x, y) = panel(x, y);
    }
  }
  return picture;
}

void Compare(const char* mesh_file, const char* truth_file, const char* picture_file) {
  const TriangleMesh mesh = ReadMesh(mesh_file), truth = ReadMesh(truth_file);
  Print("mesh", mesh);
  Print("truth", truth);
  const Samples of_mesh = SamplesOf(mesh), of_truth = SamplesOf(truth);
  Print("accuracy", of_mesh, of_truth);
  Print("completeness", of_truth, of_mesh);
  WritePng(picture_file, Drawn(mesh, truth));
}

}  // namespace
}  // namespace curvefusion

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "usage: hybrid_figures MESH TRUE_MESH FILE.png\n");
    return 2;
  }
  curvefusion::Compare(argv[1], argv[2], argv[3]);
  return 0;
}
