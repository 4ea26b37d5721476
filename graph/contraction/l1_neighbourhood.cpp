#include "graph/contraction/l1_neighbourhood.h"

#include <cstdint>

#include "kernel/wide_lanes.h"

namespace curvefusion {

namespace {

using IntLanes [[gnu::vector_size(kLanes * sizeof(int32_t))]] = int32_t;

// exp(x) for x from -4 to 0, to 1e-6 of it: the series of exp(x / 16), to the sixteenth power.
[[gnu::always_inline]] inline void ExponentialOf(const Lanes& x, Lanes& result) {
  const Lanes y = x * (1.0F / 16);
  Lanes power =
      1 + y * (1 + y * (1.0F / 2 +
                        y * (1.0F / 6 + y * (1.0F / 24 + y * (1.0F / 120 + y * (1.0F / 720))))));
  for (int doubling = 0; doubling < 4; ++doubling) power *= power;
  result = power;
}

// 1 / sqrt(x) for positive x, to single precision: half of the exponent, then Newton's iteration.
[[gnu::always_inline]] inline void InverseRootOf(const Lanes& x, Lanes& result) {
  constexpr int32_t kHalfOfExponentBias = 0x5f375a86;  // Lomont 2003
  constexpr int kIterations = 3;                       // derived: .0018, 5e-6, 4e-11 of it are left
  Lanes root =
      __builtin_bit_cast(Lanes, kHalfOfExponentBias - (__builtin_bit_cast(IntLanes, x) >> 1));
  for (int i = 0; i < kIterations; ++i) root *= 1.5F - 0.5F * x * root * root;
  result = root;
}

// What is around a place.
struct Around {
  Vec3f place;
  float squared_radius;
  float squared_softening;
};

// Points relative to a place and their weights times theta, zero beyond the radius.
struct Offsets {
  Lanes x, y, z, squared, weights;

  [[gnu::always_inline]] Offsets(const PackedArrays::Packet& points, const Around& around)
      : x(points.x - around.place.x()),
        y(points.y - around.place.y()),
        z(points.z - around.place.z()),
        squared(x * x + y * y + z * z) {
    const Lanes radius = Lanes{} + around.squared_radius;
    Lanes theta;
    ExponentialOf((squared < radius ? squared : radius) * (-4 / around.squared_radius), theta);
    weights = squared < radius ? points.weights * theta : Lanes{};
  }
};

// Adds the points of [first, last).
CURVEFUSION_WIDE_LANES void AddToDensity(const PackedArrays& points, int first, int last,
                                         const Around& around, Lanes& sum) {
  Lanes in_registers = sum;
  for (int i = first; i < last; i += kLanes) {
    in_registers += Offsets(points.Load(i, last), around).weights;
  }
  sum = in_registers;
}

struct MedianSums {
  Lanes weight{}, x{}, y{}, z{};
};

// Adds the points of [first, last).
CURVEFUSION_WIDE_LANES void AddToMedian(const PackedArrays& points, int first, int last,
                                        const Around& around, MedianSums& sums) {
  MedianSums in_registers = sums;
  for (int i = first; i < last; i += kLanes) {
    const Offsets offset(points.Load(i, last), around);
    Lanes inverse_distance;
    InverseRootOf(offset.squared + around.squared_softening, inverse_distance);
    const Lanes alpha = offset.weights * inverse_distance;
    in_registers.weight += alpha;
    in_registers.x += alpha * offset.x;
    in_registers.y += alpha * offset.y;
    in_registers.z += alpha * offset.z;
  }
  sums = in_registers;
}

struct RepulsionSums {
  Lanes weight{}, x{}, y{}, z{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
};

// Adds the points of [first, last).
CURVEFUSION_WIDE_LANES void AddToRepulsion(const PackedArrays& points, int first, int last,
                                           const Around& around, RepulsionSums& sums) {
  RepulsionSums in_registers = sums;
  for (int i = first; i < last; i += kLanes) {
    const Offsets offset(points.Load(i, last), around);
    const Lanes inverse = 1 / (offset.squared + around.squared_softening);
    const Lanes beta = offset.squared > 0 ? offset.weights * inverse : Lanes{};
    in_registers.weight += beta;
    in_registers.x += beta * offset.x;
    in_registers.y += beta * offset.y;
    in_registers.z += beta * offset.z;
    const Lanes wx = offset.weights * offset.x, wy = offset.weights * offset.y;
    in_registers.xx += wx * offset.x;
    in_registers.xy += wx * offset.y;
    in_registers.xz += wx * offset.z;
    in_registers.yy += wy * offset.y;
    in_registers.yz += wy * offset.z;
    in_registers.zz += offset.weights * offset.z * offset.z;
  }
  sums = in_registers;
}

Around AroundOf(const Vec3f& place, double radius, double softening) {
  return {place, static_cast<float>(radius * radius), static_cast<float>(softening * softening)};
}

}  // namespace

L1Neighbourhood::L1Neighbourhood(const std::vector<Vec3>& positions,
                                 const std::vector<float>& weights, double radius, double softening)
    : radius_(radius), softening_(softening), points_(positions, weights, radius) {}

double L1Neighbourhood::DensityAt(const Vec3& place, PackedPoints::Neighbours& neighbours) const {
  const Around around = AroundOf(points_.Relative(place), radius_, softening_);
  Lanes sum{};
  points_.ForEachRangeNear(place, radius_, neighbours, [&](int first, int last) {
    AddToDensity(points_.arrays(), first, last, around, sum);
  });
  return Sum(sum);
}

Vec3 L1Neighbourhood::StepToMedian(const Vec3& place, PackedPoints::Neighbours& neighbours) const {
  const Around around = AroundOf(points_.Relative(place), radius_, softening_);
  MedianSums sums;
  points_.ForEachRangeNear(place, radius_, neighbours, [&](int first, int last) {
    AddToMedian(points_.arrays(), first, last, around, sums);
  });
  const double weight = Sum(sums.weight);
  if (!(weight > 0)) return place;
  return place + Vec3(Sum(sums.x), Sum(sums.y), Sum(sums.z)) / weight;
}

L1Neighbourhood::Repulsion L1Neighbourhood::RepulsionAt(
    const Vec3& place, PackedPoints::Neighbours& neighbours) const {
  const Around around = AroundOf(points_.Relative(place), radius_, softening_);
  RepulsionSums sums;
  points_.ForEachRangeNear(place, radius_, neighbours, [&](int first, int last) {
    AddToRepulsion(points_.arrays(), first, last, around, sums);
  });
  const double weight = Sum(sums.weight);
  if (!(weight > 0)) return {};
  Repulsion repulsion;
  repulsion.offset = -Vec3(Sum(sums.x), Sum(sums.y), Sum(sums.z)) / weight;
  repulsion.covariance << Sum(sums.xx), Sum(sums.xy), Sum(sums.xz), Sum(sums.xy), Sum(sums.yy),
      Sum(sums.yz), Sum(sums.xz), Sum(sums.yz), Sum(sums.zz);
  return repulsion;
}

}  // namespace curvefusion
