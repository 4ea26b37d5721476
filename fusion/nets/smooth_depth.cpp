#include "fusion/nets/smooth_depth.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/geometry.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr int kSquare = SmoothDepth::kSquare;
constexpr int kMinSquares = 6;  // of nine, with a depth; chosen: a plane is well determined
// Metres from the plane of a surface. Chosen, instead of three standard deviations of noise: depth
// mixes the wires and gaps of a net (docs/lab_notebook.md#nets-kept).
constexpr double kRoughness = 0.01;
constexpr int kRows = 8;  // for a thread at a time; chosen

// The median of the depths in a square; 0 where most of it measured nothing.
float MedianDepth(const DepthImage& depth, int first_u, int first_v) {
  std::array<float, kSquare * kSquare> values;
  size_t count = 0;
  for (int v = first_v; v < first_v + kSquare; ++v)
    for (int u = first_u; u < first_u + kSquare; ++u)
      if (depth(u, v) > 0 && depth(u, v) < SmoothDepth::kMaxDepth) values[count++] = depth(u, v);
  if (2 * count < values.size()) return 0;
  const auto middle = values.begin() + static_cast<int64_t>(count / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<int64_t>(count));
  return *middle;
}

// The middle of the plane through a square and those around it; 0 where they are not of one.
float OnPlane(const DepthImage& squares, int u, int v) {
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  Vec3 sums = Vec3::Zero();
  const auto for_each = [&](const auto& body) {
    for (int dv = -1; dv <= 1; ++dv)
      for (int du = -1; du <= 1; ++du)
        if (squares(u + du, v + dv) > 0) body(Vec3(1, du, dv), squares(u + du, v + dv));
  };
  int count = 0;
  for_each([&](const Vec3& at, double z) {
    moments += at * at.transpose();
    sums += z * at;
    ++count;
  });
  if (count < kMinSquares) return 0;
  const Vec3 plane = moments.ldlt().solve(sums);
  double farthest = 0;
  for_each([&](const Vec3& at, double z) {
    farthest = std::max(farthest, std::abs(plane.dot(at) - z));
  });
  return farthest < kRoughness ? static_cast<float>(plane(0)) : 0;
}

}  // namespace

DepthImage SquareMedians(const DepthImage& depth) {
  DepthImage squares(depth.width() / kSquare, depth.height() / kSquare, 0);
  ParallelFor(0, squares.height(), kRows, [&](int64_t row) {
    const int v = static_cast<int>(row);
    for (int u = 0; u < squares.width(); ++u)
      squares(u, v) = MedianDepth(depth, u * kSquare, v * kSquare);
  });
  return squares;
}

SmoothDepth::SmoothDepth(const DepthImage& depth)
    : smooth_(depth.width() / kSquare, depth.height() / kSquare, 0) {
  const DepthImage squares = SquareMedians(depth);
  ParallelFor(1, squares.height() - 1, kRows, [&](int64_t v) {
    for (int u = 1; u + 1 < squares.width(); ++u)
      smooth_(u, static_cast<int>(v)) = OnPlane(squares, u, static_cast<int>(v));
  });
}

float SmoothDepth::At(int u, int v) const {
  const float x = (static_cast<float>(u) + 0.5f) / kSquare - 0.5f;
  const float y = (static_cast<float>(v) + 0.5f) / kSquare - 0.5f;
  const int u0 = static_cast<int>(std::floor(x)), v0 = static_cast<int>(std::floor(y));
  float sum = 0, weights = 0;
  for (int i = 0; i < 4; ++i) {
    const int u1 = u0 + i % 2, v1 = v0 + i / 2;
    if (!smooth_.Contains(u1, v1) || !(smooth_(u1, v1) > 0)) continue;
    const float weight =
        (1 - std::abs(x - static_cast<float>(u1))) * (1 - std::abs(y - static_cast<float>(v1)));
    sum += weight * smooth_(u1, v1);
    weights += weight;
  }
  return weights >= 0.5f ? sum / weights : 0;
}

}  // namespace curvefusion
