#include "experiments/pictures/mesh_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "capture/image_mat.h"
#include "experiments/pictures/picture_style.h"

namespace curvefusion {

namespace {

constexpr double kAmbient = 0.25;  // of the light that falls on a surface from all sides
constexpr double kGrey = 205;      // of a surface that faces the viewer

// Pixels with the depth of the nearest surface so far (larger is nearer) and its shade.
class DepthBuffer {
 public:
  DepthBuffer(int width, int height)
      : picture_(width, height, kWhite),
        depth_(width, height, -std::numeric_limits<float>::max()) {}

  // A triangle in pixels (x right, y down) with depths.
  void Draw(const std::array<Vec3, 3>& corners, uint8_t shade) {
    const auto [left, right] = Range(corners, 0, picture_.width());
    const auto [top, bottom] = Range(corners, 1, picture_.height());
    const double area = Cross(corners[0], corners[1], corners[2].x(), corners[2].y());
    if (area == 0) return;
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) {
        const double a = Cross(corners[1], corners[2], x, y) / area;
        const double b = Cross(corners[2], corners[0], x, y) / area;
        if (a < 0 || b < 0 || a + b > 1) continue;
        const double z = a * corners[0].z() + b * corners[1].z() + (1 - a - b) * corners[2].z();
        if (z <= depth_(x, y)) continue;
        depth_(x, y) = static_cast<float>(z);
        picture_(x, y) = {shade, shade, shade};
      }
    }
  }

  ColorImage& picture() { return picture_; }

 private:
  static double Cross(const Vec3& a, const Vec3& b, double x, double y) {
    return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
  }

  // First and one past the last pixel that a triangle may touch along an axis.
  static std::pair<int, int> Range(const std::array<Vec3, 3>& corners, int axis, int size) {
    const auto [least, greatest] =
        std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
    return {static_cast<int>(std::clamp(std::floor(least), 0.0, double(size))),
            static_cast<int>(std::clamp(std::ceil(greatest) + 1, 0.0, double(size)))};
  }

  ColorImage picture_;
  Image<float> depth_;
};

}  // namespace

ColorImage DrawMesh(const TriangleMesh& mesh, const OrthographicView& view,
                    const Eigen::AlignedBox3d& bounds, int width, int height, double scale) {
  DepthBuffer buffer(width * kSupersampling, height * kSupersampling);
  const double pixels = scale * kSupersampling;
  const Vec3 middle = bounds.isEmpty() ? Vec3::Zero() : Vec3(bounds.center());
  for (const auto& triangle : mesh.triangles) {
    std::array<Vec3, 3> p_view;
    std::array<Vec3, 3> corners;
    for (int i = 0; i < 3; ++i) {
      p_view[i] = view.R_view_world * mesh.vertices[triangle[i]].cast<double>() - middle;
      corners[i] = {kSupersampling * width / 2. + pixels * p_view[i].x(),
                    kSupersampling * height / 2. - pixels * p_view[i].y(), p_view[i].z()};
    }
    const Vec3 normal = (p_view[1] - p_view[0]).cross(p_view[2] - p_view[0]).normalized();
    const double light = kAmbient + (1 - kAmbient) * std::abs(normal.z());
    if (normal.allFinite()) buffer.Draw(corners, static_cast<uint8_t>(kGrey * light));
  }
  return ShrunkTo(width, height, buffer.picture());
}

}  // namespace curvefusion
