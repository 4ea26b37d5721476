#include "experiments/simulation/dot_pattern.h"

#include <numbers>

#include "experiments/simulation/random.h"

namespace curvefusion {
namespace {

constexpr double kDotSigma = 0.5;

int Wrapped(int value, int size) { return (value + size) % size; }

}  // namespace

DotPattern::DotPattern(uint64_t seed)
    : dots_(kWidth * kHeight, false), cells_(static_cast<size_t>(kWidth) * kHeight) {
  ThrowDots(seed);
  FillCells();
  const int steps = static_cast<int>(kReach * kReach * kProfileSteps) + 1;
  for (int i = 0; i < steps; ++i) {
    const double square = (i + 0.5) / kProfileSteps;
    const double variance = kDotSigma * kDotSigma;
    profile_.push_back(
        static_cast<float>(std::exp(-square / (2 * variance)) / (2 * std::numbers::pi * variance)));
  }
}

void DotPattern::ThrowDots(uint64_t seed) {
  Random random(seed, RandomStream::kPattern);
  for (int thrown = 0; thrown < kDots;) {
    const int column = static_cast<int>(random.Next() % kWidth);
    const int row = static_cast<int>(random.Next() % kHeight);
    bool free = true;
    for (int dv = -1; dv <= 1; ++dv) {
      for (int du = -1; du <= 1; ++du) {
        free = free && !HasDot(Wrapped(column + du, kWidth), Wrapped(row + dv, kHeight));
      }
    }
    if (!free) continue;
    dots_[row * kWidth + column] = true;
    ++thrown;
  }
}

void DotPattern::FillCells() {
  uint16_t dot = 0;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      if (!HasDot(column, row)) continue;
      for (int dv = -1; dv <= 1; ++dv) {
        for (int du = -1; du <= 1; ++du) {
          Cell& cell = cells_[Wrapped(row - dv, kHeight) * kWidth + Wrapped(column - du, kWidth)];
          cell.du[cell.count] = static_cast<int8_t>(du);
          cell.dv[cell.count] = static_cast<int8_t>(dv);
          cell.dot[cell.count] = dot;
          ++cell.count;
        }
      }
      ++dot;
    }
  }
}

}  // namespace curvefusion
