#include "experiments/baselines/silhouette_voxels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fusion/volume/marching_cubes.h"
#include "fusion/volume/voxel_blocks.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// A disc of the mean projected area of a cube of side 1: pi r^2 = 6 / 4.
const double kBallRadius = std::sqrt(1.5 / std::numbers::pi);
constexpr double kHalfDiagonal = 0.7072;  // of a pixel: a disc of it holds the nearest centre
constexpr double kLeastViews = 0.5;       // share of the views that must see a voxel; chosen
// Pixels that a change must pay, of the hundred or so that a voxel covers; chosen: with .001 the
// search takes half as long again, for a sum .5 % less (docs/lab_notebook.md).
constexpr double kLeastGain = 1;

struct Candidate {
  VoxelKey key;
  float support = 0;
  bool is_occupied = false;
};

class SilhouetteFit {
 public:
  SilhouetteFit(const std::vector<SilhouetteMap>& maps, double voxel_size)
      : voxel_size_(voxel_size) {
    for (const SilhouetteMap& map : maps) {
      views_.push_back({map.camera, map.T_world_camera.inverse(), excess_.size()});
      const float* p = map.probability.data();
      for (size_t i = 0; i < map.probability.size(); ++i) {
        excess_.push_back(2 * p[i] - 1);
        error_ += static_cast<double>(p[i]) * p[i];
      }
    }
    covering_.assign(excess_.size(), 0);
  }

  // Voxels of the box with support, the best first.
  void FindCandidates(const Eigen::AlignedBox3d& box) {
    const Eigen::Array3i first = (box.min() / voxel_size_).array().ceil().cast<int>();
    const Eigen::Array3i last = (box.max() / voxel_size_).array().floor().cast<int>();
    std::vector<std::vector<Candidate>> of_layer(std::max(0, last.z() - first.z() + 1));
    ParallelFor(0, static_cast<int64_t>(of_layer.size()), 1, [&](int64_t layer) {
      VoxelKey key;
      key.z = first.z() + static_cast<int>(layer);
      for (key.y = first.y(); key.y <= last.y(); ++key.y) {
        for (key.x = first.x(); key.x <= last.x(); ++key.x) {
          const float support = Support(key);
          if (support > 0) of_layer[layer].push_back({key, support});
        }
      }
    });
    for (const auto& layer : of_layer) {
      candidates_.insert(candidates_.end(), layer.begin(), layer.end());
    }
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const auto& a, const auto& b) { return a.support > b.support; });
  }

  // Occupies the candidates down to the support that gives the least error.
  void StartFromBestHull() {
    size_t best = 0;
    double least = error_;
    for (size_t i = 0; i < candidates_.size(); ++i) {
      Flip(candidates_[i]);
      if (error_ < least) best = i + 1;
      least = std::min(least, error_);
    }
    for (size_t i = best; i < candidates_.size(); ++i) Flip(candidates_[i]);
  }

  // Changes voxels until no single change lowers the error any more; each lowers it, so it ends.
  void SearchLocalMinimum(const Progress& progress) {
    int64_t sweeps = 0;
    for (bool has_changed = true; has_changed;) {
      has_changed = false;
      for (Candidate& candidate : candidates_) {
        if (ChangeByFlip(candidate) > -kLeastGain) continue;
        Flip(candidate);
        has_changed = true;
      }
      progress("voxels", ++sweeps, 0);
    }
  }

  VoxelSet Result() const {
    VoxelSet set{voxel_size_, {}, error_};
    for (const Candidate& candidate : candidates_) {
      if (candidate.is_occupied) set.voxels.push_back(candidate.key);
    }
    std::sort(set.voxels.begin(), set.voxels.end());
    return set;
  }

 private:
  struct View {
    PinholeCamera camera;
    RigidTransform T_camera_world;
    size_t first_pixel;  // of it in excess_ and covering_
  };

  // Calls body(pixel) for all pixels of a view that a voxel covers.
  template <class Body>
  void ForPixelsOf(const View& view, const VoxelKey& key, const Body& body) const {
    const Vec3 p = view.T_camera_world * (voxel_size_ * Vec3(key.x, key.y, key.z));
    if (p.z() < voxel_size_) return;
    const Vec2 center = view.camera.Project(p);
    const double radius =
        std::max(view.camera.fx * kBallRadius * voxel_size_ / p.z(), kHalfDiagonal);
    const int top = std::max(0, static_cast<int>(std::ceil(center.y() - radius)));
    const int bottom =
        std::min(view.camera.height - 1, static_cast<int>(std::floor(center.y() + radius)));
    for (int v = top; v <= bottom; ++v) {
      const double half = std::sqrt(radius * radius - (v - center.y()) * (v - center.y()));
      const int left = std::max(0, static_cast<int>(std::ceil(center.x() - half)));
      const int right =
          std::min(view.camera.width - 1, static_cast<int>(std::floor(center.x() + half)));
      for (int u = left; u <= right; ++u) {
        body(view.first_pixel + static_cast<size_t>(v) * view.camera.width + u);
      }
    }
  }

  // Mean of 2 P - 1 over the pixels of a voxel, each view counting once; -1 where few views see it,
  // and where it cannot become positive.
  float Support(const VoxelKey& key) const {
    double sum = 0;
    int seen = 0;
    auto left = static_cast<double>(views_.size());
    for (const View& view : views_) {
      if (sum + left-- <= 0) return -1;
      double of_view = 0;
      int pixels = 0;
      ForPixelsOf(view, key, [&](size_t pixel) {
        of_view += excess_[pixel];
        ++pixels;
      });
      if (pixels == 0) continue;
      sum += of_view / pixels;
      ++seen;
    }
    if (seen == 0 || seen < kLeastViews * static_cast<double>(views_.size())) return -1;
    return static_cast<float>(sum / seen);
  }

  // A covered pixel costs (1 - P)^2, another P^2: covering it changes the error by 1 - 2 P.
  double ChangeByFlip(const Candidate& candidate) const {
    const uint16_t others = candidate.is_occupied ? 1 : 0;
    double gain = 0;
    for (const View& view : views_) {
      ForPixelsOf(view, candidate.key, [&](size_t pixel) {
        if (covering_[pixel] == others) gain += excess_[pixel];
      });
    }
    return candidate.is_occupied ? gain : -gain;
  }

  void Flip(Candidate& candidate) {
    error_ += ChangeByFlip(candidate);
    const int step = candidate.is_occupied ? -1 : 1;
    for (const View& view : views_) {
      ForPixelsOf(view, candidate.key, [&](size_t pixel) {
        covering_[pixel] = static_cast<uint16_t>(covering_[pixel] + step);
      });
    }
    candidate.is_occupied = !candidate.is_occupied;
  }

  double voxel_size_;
  std::vector<View> views_;
  std::vector<float> excess_;       // 2 P - 1 of every pixel of every view
  std::vector<uint16_t> covering_;  // how many occupied voxels cover it
  std::vector<Candidate> candidates_;
  double error_ = 0;
};

// The number of the block that holds a voxel; a new one is empty space.
int BlockHolding(const VoxelKey& voxel, VoxelBlockGrid& grid) {
  const VoxelKey key = BlockOf(voxel);
  if (const int block = grid.Find(key); block != VoxelBlockGrid::kNone) return block;
  const int block = grid.Insert(key);
  grid.block(block).tsdf.fill(1);
  grid.block(block).weight.fill(1);
  return block;
}

}  // namespace

VoxelSet FitVoxelsToSilhouettes(const std::vector<SilhouetteMap>& maps,
                                const Eigen::AlignedBox3d& box, double voxel_size,
                                const Progress& progress) {
  SilhouetteFit fit(maps, voxel_size);
  fit.FindCandidates(box);
  progress("visual hull", 0, 1);
  fit.StartFromBestHull();
  fit.SearchLocalMinimum(progress);
  return fit.Result();
}

TriangleMesh SurfaceOf(const VoxelSet& set) {
  VoxelBlockGrid grid;
  for (const VoxelKey& voxel : set.voxels) {
    for (int i = 0; i < 27; ++i) {  // cells at the border need the empty voxels around
      BlockHolding({voxel.x + i % 3 - 1, voxel.y + i / 3 % 3 - 1, voxel.z + i / 9 - 1}, grid);
    }
    grid.block(BlockHolding(voxel, grid)).tsdf[IndexInBlock(voxel)] = -1;
  }
  for (int block = 0; block < grid.size(); ++block) {
    grid.SetSigns(block, FindSigns(grid.block(block)));
  }
  return MarchingCubes(grid, set.voxel_size);
}

}  // namespace curvefusion
