#include "fusion/solid_parts/solid_field.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "fusion/solid_parts/surface_triangles.h"
#include "fusion/solid_parts/winding_number.h"
#include "fusion/volume/marching_cubes.h"
#include "kernel/disjoint_sets.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Chosen. Voxels: a vertex keeps so far from the samples on either side, which avoids slivers.
constexpr double kLeastValue = 0.1;
constexpr int kGap = 2;             // voxels, of the ball that closes hidden gaps
constexpr double kGroupVoxels = 8;  // of triangles whose winding is taken together

// Taubin's factors, and rounds; chosen: what is a few voxels wide stays.
constexpr double kShrink = 0.5;
constexpr double kInflate = -0.53;
constexpr int kSmoothingRounds = 10;

using Corners = std::array<Vec3, 3>;

// Ericson 2005, 5.1.5: the nearest point of a triangle.
Vec3 NearestOn(const Corners& t, const Vec3& p) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return t[0];
  const Vec3 bp = p - t[1];
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return t[1];
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return t[0] + d1 / (d1 - d3) * ab;
  const Vec3 cp = p - t[2];
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return t[2];
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return t[0] + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    return t[1] + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t[2] - t[1]);
  }
  const double whole = va + vb + vc;
  return whole > 0 ? Vec3(t[0] + vb / whole * ab + vc / whole * ac) : t[0];
}

// Moved against its normals.
TriangleMesh MovedInwards(const TriangleMesh& surface, double distance) {
  std::vector<Vec3> normals(surface.vertices.size(), Vec3::Zero());
  for (size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto [a, b, c] = CornersOf(surface, i);
    for (const int v : surface.triangles[i]) normals[v] += (b - a).cross(c - a);
  }
  TriangleMesh moved = surface;
  for (size_t v = 0; v < normals.size(); ++v) {
    moved.vertices[v] -= (distance * normals[v].normalized()).cast<float>();
  }
  return moved;
}

// Samples of a field on the lattice of a volume, within a box of voxels.
class SolidField {
 public:
  SolidField(const TriangleMesh& surface, double voxel_size, double thickness)
      : voxel_size_(voxel_size), thickness_(thickness) {
    Eigen::AlignedBox3d box;
    for (const Vec3f& v : surface.vertices) box.extend(v.cast<double>());
    const double margin = thickness + 2 * voxel_size;
    low_ = VoxelOf(box.min() - Vec3::Constant(margin), voxel_size);
    const VoxelKey high = VoxelOf(box.max() + Vec3::Constant(margin), voxel_size);
    size_ = {high.x - low_.x + 1, high.y - low_.y + 1, high.z - low_.z + 1};
    values_.assign(static_cast<size_t>(size_[0]) * size_[1] * size_[2],
                   static_cast<float>(voxel_size));
    is_free_.assign(values_.size(), 0);
  }

  // What lies within half the thickness of a surface that was moved inwards by as much.
  void AddLayer(const TriangleMesh& middle) {
    ForEachNear(middle, thickness_ / 2 + voxel_size_,
                [&](const Corners& corners, const Vec3& p, float& value) {
                  const double distance = (NearestOn(corners, p) - p).norm() - thickness_ / 2;
                  value = std::min(value, static_cast<float>(distance));
                });
  }

  // What lies behind a surface, within what a layer reaches.
  void CutBehind(const TriangleMesh& room) {
    const double reach = thickness_ + 2 * voxel_size_;
    ForEachNear(room, reach, [&](const Corners& corners, const Vec3& p, float& value) {
      if ((NearestOn(corners, p) - p).norm() > reach) return;
      const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
      value = std::max(value, static_cast<float>(normal.dot(corners[0] - p)));
    });
  }

  // What was not seen free and is enclosed; what was seen free is none.
  void AddEnclosedAndCarve(const TsdfVolume& volume, const WindingNumber& winding) {
    ParallelFor(0, size_[2], 1, [&](int64_t k) {
      for (int j = 1; j + 1 < size_[1]; ++j)
        for (int i = 1; i + 1 < size_[0]; ++i) {
          const VoxelKey voxel{low_.x + i, low_.y + j, low_.z + static_cast<int>(k)};
          const double seen = volume.DistanceAt(voxel);
          float& value = values_[IndexOf(voxel)];
          is_free_[IndexOf(voxel)] = seen > 0;
          if (seen > 0) {
            value = std::max(value, static_cast<float>(seen));
          } else if (value > 0) {
            const double excess = winding.At(voxel_size_ * Vec3(voxel.x, voxel.y, voxel.z)) - 0.5;
            value = std::min(value, static_cast<float>(-4 * voxel_size_ * excess));
          }
        }
    });
  }

  // A closing by a ball, of what was not seen free: hidden gaps narrower than it are solid.
  void CloseGaps() {
    std::vector<char> grown(values_.size());
    for (size_t i = 0; i < values_.size(); ++i) grown[i] = values_[i] < 0 || is_free_[i];
    const std::vector<char> solid_or_free = grown;
    ForEachInner([&](size_t index, const std::vector<std::ptrdiff_t>& ball) {
      if (values_[index] >= 0) return;
      for (const std::ptrdiff_t step : ball) grown[index + step] = 1;
    });
    ForEachInner([&](size_t index, const std::vector<std::ptrdiff_t>& ball) {
      if (solid_or_free[index] || !grown[index]) return;
      const bool is_gap = std::all_of(
          ball.begin(), ball.end(), [&](std::ptrdiff_t step) { return grown[index + step] != 0; });
      if (is_gap) values_[index] = static_cast<float>(-voxel_size_ / 2);
    });
  }

  TriangleMesh Surface() const {
    VoxelBlockGrid grid;
    const VoxelKey first = BlockOf(low_);
    const VoxelKey last = BlockOf({low_.x + size_[0], low_.y + size_[1], low_.z + size_[2]});
    for (int z = first.z; z <= last.z; ++z)
      for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
          VoxelBlock& block = grid.block(grid.Insert({x, y, z}));
          for (int k = 0; k < kBlockVoxels; ++k) {
            block.tsdf[k] = Sample({8 * x + k % 8, 8 * y + k / 8 % 8, 8 * z + k / 64});
          }
          grid.SetSigns(grid.size() - 1, FindSigns(block));
        }
    return MarchingCubes(grid, voxel_size_);
  }

 private:
  // Calls visit(corners, p, value) for the samples in the box of each triangle, grown by `reach`.
  template <class Visit>
  void ForEachNear(const TriangleMesh& mesh, double reach, const Visit& visit) {
    const Vec3 margin = Vec3::Constant(reach);
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
      const Corners corners = CornersOf(mesh, i);
      Eigen::AlignedBox3d box;
      for (const Vec3& corner : corners) box.extend(corner);
      const VoxelKey first = VoxelOf(box.min() - margin, voxel_size_);
      const VoxelKey last = VoxelOf(box.max() + margin, voxel_size_);
      for (int z = std::max(first.z, low_.z); z <= std::min(last.z, low_.z + size_[2] - 1); ++z)
        for (int y = std::max(first.y, low_.y); y <= std::min(last.y, low_.y + size_[1] - 1); ++y)
          for (int x = std::max(first.x, low_.x); x <= std::min(last.x, low_.x + size_[0] - 1); ++x)
            visit(corners, voxel_size_ * Vec3(x, y, z), values_[IndexOf({x, y, z})]);
    }
  }

  // Calls visit(index, ball) for the samples around which a ball of two voxels is stored: `ball`
  // has the steps from the sample's index to those of the ball.
  template <class Visit>
  void ForEachInner(const Visit& visit) const {
    std::vector<std::ptrdiff_t> ball;
    const std::ptrdiff_t row = size_[0], layer = row * size_[1];
    for (int z = -kGap; z <= kGap; ++z)
      for (int y = -kGap; y <= kGap; ++y)
        for (int x = -kGap; x <= kGap; ++x)
          if (x * x + y * y + z * z <= kGap * kGap) ball.push_back(x + y * row + z * layer);
    for (int z = kGap; z + kGap < size_[2]; ++z)
      for (int y = kGap; y + kGap < size_[1]; ++y)
        for (int x = kGap; x + kGap < size_[0]; ++x)
          visit(static_cast<size_t>(x + y * row + z * layer), ball);
  }

  bool Holds(const VoxelKey& v) const {
    return v.x >= low_.x && v.y >= low_.y && v.z >= low_.z && v.x < low_.x + size_[0] &&
           v.y < low_.y + size_[1] && v.z < low_.z + size_[2];
  }
  size_t IndexOf(const VoxelKey& v) const {
    return static_cast<size_t>(v.x - low_.x) +
           static_cast<size_t>(size_[0]) *
               (static_cast<size_t>(v.y - low_.y) +
                static_cast<size_t>(size_[1]) * static_cast<size_t>(v.z - low_.z));
  }
  // In voxels, not near zero.
  float Sample(const VoxelKey& v) const {
    if (!Holds(v)) return 1;
    const double value = std::clamp(values_[IndexOf(v)] / voxel_size_, -1.0, 1.0);
    return static_cast<float>(value < 0 ? std::min(value, -kLeastValue)
                                        : std::max(value, kLeastValue));
  }

  double voxel_size_;
  double thickness_;
  VoxelKey low_;
  std::array<int, 3> size_{};
  std::vector<float> values_;  // metres, negative inside
  std::vector<char> is_free_;  // some frame saw it so
};

// One step of Laplacian smoothing: every vertex goes `share` of the way to the mean of its
// neighbours.
void MoveToNeighbours(double share, TriangleMesh& mesh) {
  std::vector<Vec3> sum(mesh.vertices.size(), Vec3::Zero());
  std::vector<int> count(mesh.vertices.size(), 0);
  for (const auto& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      sum[triangle[k]] += mesh.vertices[triangle[(k + 1) % 3]].cast<double>();
      ++count[triangle[k]];
    }
  }
  for (size_t v = 0; v < sum.size(); ++v) {
    if (count[v] == 0) continue;
    const Vec3 before = mesh.vertices[v].cast<double>();
    mesh.vertices[v] = (before + share * (sum[v] / count[v] - before)).cast<float>();
  }
}

// Taubin 1995: the staircases where what was observed ends go, the volume stays.
void Smooth(TriangleMesh& mesh) {
  for (int round = 0; round < kSmoothingRounds; ++round) {
    MoveToNeighbours(kShrink, mesh);
    MoveToNeighbours(kInflate, mesh);
  }
}

// Hollows, which have a negative volume, go with small pieces.
TriangleMesh WithoutSmall(const TriangleMesh& mesh, double min_volume) {
  DisjointSets sets(mesh.vertices.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.Unite(a, b);
    sets.Unite(b, c);
  }
  std::map<int, double> volume;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, c] = CornersOf(mesh, i);
    volume[sets.Root(mesh.triangles[i][0])] += a.dot(b.cross(c)) / 6;
  }
  TriangleMarks kept;
  for (const auto& triangle : mesh.triangles) {
    kept.push_back(volume[sets.Root(triangle[0])] >= min_volume);
  }
  return MarkedPart(mesh, kept);
}

// The surface, and the contact as seen from outside.
TriangleMesh WithContact(const SolidBounds& bounds) {
  TriangleMesh closed = bounds.surface, turned = bounds.contact;
  for (auto& triangle : turned.triangles) std::swap(triangle[1], triangle[2]);
  Append(turned, closed);
  return closed;
}

}  // namespace

TriangleMesh SolidBehind(const SolidBounds& bounds, const TsdfVolume& volume, double thickness,
                         double min_volume) {
  if (bounds.surface.triangles.empty()) return {};
  const double voxel_size = volume.voxel_size();
  SolidField field(bounds.surface, voxel_size, thickness);
  field.AddLayer(MovedInwards(bounds.surface, thickness / 2));
  field.AddEnclosedAndCarve(volume, WindingNumber(WithContact(bounds), kGroupVoxels * voxel_size));
  field.CloseGaps();
  field.CutBehind(bounds.room);
  field.CutBehind(bounds.contact);
  TriangleMesh solid = WithoutSmall(field.Surface(), min_volume);
  Smooth(solid);
  return solid;
}

}  // namespace curvefusion
