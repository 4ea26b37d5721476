#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "experiments/simulation/floor.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// A projected pattern of light dots like that of the PrimeSense projector: a tile of 211x165
/// pixels with 3861 dots (11.09 %), no two of which are 8-adjacent, repeated over the image. The
/// real pattern is not reproduced: the dots are thrown at random.
class DotPattern {
 public:
  static constexpr int kWidth = 211;
  static constexpr int kHeight = 165;
  static constexpr int kDots = 3861;

  explicit DotPattern(uint64_t seed);

  /// Light at a position of the projector's image in pixels: the sum over near dots of gain(dot)
  /// times a Gaussian of sigma .5 px and integral 1. `gain` gets a number that differs between all
  /// dots, those of repeated tiles included.
  template <class Gain>
  double Light(double u, double v, const Gain& gain) const {
    const int column = Floor(u + 0.5);
    const int row = Floor(v + 0.5);
    const int tile_column = FloorDivide(column, kWidth);
    const int tile_row = FloorDivide(row, kHeight);
    const Cell& cell = cells_[(row - tile_row * kHeight) * kWidth + column - tile_column * kWidth];
    double light = 0;
    for (int k = 0; k < cell.count; ++k) {
      const double du = u - column - cell.du[k];
      const double dv = v - row - cell.dv[k];
      const double square = du * du + dv * dv;
      if (square >= kReach * kReach) continue;
      // A dot over a tile's seam counts as a dot of the tile it is seen from: no visible harm.
      const uint64_t dot =
          cell.dot[k] + 4096 * static_cast<uint64_t>(tile_column + 64 + 128 * (tile_row + 64));
      light += profile_[static_cast<int>(square * kProfileSteps)] * gain(dot);
    }
    return light;
  }

  /// Whether the tile has a dot at a pixel.
  bool HasDot(int column, int row) const { return dots_[row * kWidth + column]; }

 private:
  static constexpr double kReach = 1.5;  // three sigma of a dot
  static constexpr int kProfileSteps = 1024;

  // The dots in the 3x3 pixels around one; more than four cannot be, as no two touch.
  struct Cell {
    int count = 0;
    std::array<int8_t, 4> du{};
    std::array<int8_t, 4> dv{};
    std::array<uint16_t, 4> dot{};
  };

  static int FloorDivide(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }
  void ThrowDots(uint64_t seed);
  void FillCells();

  std::vector<bool> dots_;
  std::vector<Cell> cells_;
  std::vector<float> profile_;  // by squared distance
};

}  // namespace curvefusion
