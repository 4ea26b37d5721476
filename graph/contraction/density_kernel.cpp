#include "graph/contraction/density_kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace curvefusion {

namespace {

// Neighbours do for kernels so far from where they were gathered, in sigma, and turned by an angle
// of this cosine at most. Chosen: what is then missed lies at the kernel's edge, where it weighs
// nothing.
constexpr double kSlack = 0.5;
constexpr double kLeastCosine = 0.9;

// The sums that make up moments, four points at a time.
class KernelSums {
 public:
  KernelSums(const KernelPlace& place, double sigma, const Vec3f& at)
      : at_(at),
        along_(place.direction.cast<float>()),
        along_scale_(static_cast<float>(1 - 1 / (place.stretch * place.stretch))),
        scale_(static_cast<float>(1 / (8 * sigma * sigma))) {}

  // All points of [first, last).
  CURVEFUSION_WIDE_LANES void Add(const PackedArrays& points, int first, int last) {
    KernelSums in_registers = *this;
    for (int i = first; i < last; i += kLanes) in_registers.Add(points.Load(i, last));
    *this = in_registers;
  }

  KernelMoments Moments() const {
    KernelMoments moments;
    moments.weight = Sum(sum_);
    if (moments.weight <= 0) return moments;
    moments.mean = Vec3(Sum(x_), Sum(y_), Sum(z_)) / moments.weight;
    Mat3 second;
    second << Sum(xx_), Sum(xy_), Sum(xz_), Sum(xy_), Sum(yy_), Sum(yz_), Sum(xz_), Sum(yz_),
        Sum(zz_);
    moments.covariance = second / moments.weight - moments.mean * moments.mean.transpose();
    return moments;
  }

 private:
  [[gnu::always_inline]] void Add(const PackedArrays::Packet& points) {
    const Lanes dx = points.x - at_.x();
    const Lanes dy = points.y - at_.y();
    const Lanes dz = points.z - at_.z();
    const Lanes t_along = dx * along_.x() + dy * along_.y() + dz * along_.z();
    const Lanes squared = dx * dx + dy * dy + dz * dz - along_scale_ * t_along * t_along;
    Lanes t = 1.0F - scale_ * squared;
    t = t > 0 ? t : Lanes{};
    const Lanes weight = points.weights * (t * t) * (t * t);
    const Lanes wx = weight * dx;
    const Lanes wy = weight * dy;
    const Lanes wz = weight * dz;
    sum_ += weight;
    x_ += wx;
    y_ += wy;
    z_ += wz;
    xx_ += wx * dx;
    yy_ += wy * dy;
    zz_ += wz * dz;
    xy_ += wx * dy;
    xz_ += wx * dz;
    yz_ += wy * dz;
  }

  Vec3f at_, along_;
  float along_scale_, scale_;
  Lanes sum_{}, x_{}, y_{}, z_{}, xx_{}, yy_{}, zz_{}, xy_{}, xz_{}, yz_{};
};

// The stick around which a long kernel extends by as much as across it.
Vec3 HalfStick(const KernelPlace& place, double sigma) {
  return (place.stretch - 1) * kKernelSupport * sigma * place.direction;
}

// The squared distance of a place, relative to the middle of a stick, from the stick.
double SquaredDistanceFromStick(const Vec3& place, const Vec3& half_stick) {
  const double squared = half_stick.squaredNorm();
  const double t = squared > 0 ? std::clamp(place.dot(half_stick) / squared, -1.0, 1.0) : 0;
  return (place - t * half_stick).squaredNorm();
}

// The same, for packets of points.
struct Stick {
  Vec3f middle, half;
  float inverse;  // of the squared half length
  float squared_reach;

  Stick(const Vec3f& center, const Vec3& half_stick, double reach)
      : middle(center),
        half(half_stick.cast<float>()),
        inverse(static_cast<float>(1 / std::max(half_stick.squaredNorm(), 1e-30))),
        squared_reach(static_cast<float>(reach * reach)) {}

  [[gnu::always_inline]] void FindSquaredDistances(const PackedArrays::Packet& points,
                                                   Lanes& squared) const {
    Lanes dx = points.x - middle.x();
    Lanes dy = points.y - middle.y();
    Lanes dz = points.z - middle.z();
    Lanes t = inverse * (dx * half.x() + dy * half.y() + dz * half.z());
    t = t > 1 ? Lanes{} + 1 : t;
    t = t < -1 ? Lanes{} - 1 : t;
    dx -= t * half.x();
    dy -= t * half.y();
    dz -= t * half.z();
    squared = dx * dx + dy * dy + dz * dz;
  }
};

// Appends the points of a cell that are near a stick to the first `count` in `near`, where there is
// room for all; returns how many there are then.
CURVEFUSION_WIDE_LANES int AppendNear(const PackedArrays& points, const PackedPoints::Run& cell,
                                      const Stick& stick, int count, PackedArrays& near) {
  for (int first = cell.first; first < cell.last; first += kLanes) {
    Lanes squared;
    stick.FindSquaredDistances(points.Load(first, cell.last), squared);
    const int last = std::min(kLanes, cell.last - first);
    for (int lane = 0; lane < last; ++lane) {
      near.x[count] = points.x[first + lane];
      near.y[count] = points.y[first + lane];
      near.z[count] = points.z[first + lane];
      near.weights[count] = points.weights[first + lane];
      count += squared[lane] <= stick.squared_reach;
    }
  }
  return count;
}

}  // namespace

DensityField::DensityField(const ObservedPoints& points, double sigma)
    : sigma_(sigma), points_(points.positions, points.counts, kKernelSupport * sigma) {}

bool DensityField::Suffice(const Neighbours& neighbours, const KernelPlace& place) const {
  const KernelPlace& gathered = neighbours.place_;
  if (!neighbours.is_gathered_ || gathered.stretch != place.stretch) return false;
  const double slack = kSlack * sigma_;
  if ((place.position - gathered.position).squaredNorm() > slack * slack) return false;
  return std::abs(place.direction.dot(gathered.direction)) >= kLeastCosine;
}

void DensityField::Gather(const KernelPlace& place, Neighbours& neighbours) const {
  neighbours.place_ = place;
  neighbours.is_gathered_ = true;
  const double reach = (kKernelSupport + kSlack) * sigma_;
  const Vec3 half_stick = HalfStick(place, sigma_);
  const Vec3 extent = half_stick.cwiseAbs() + Vec3::Constant(reach);
  points_.FindCells(place.position - extent, place.position + extent, neighbours.cells_);
  const double cell_reach = reach + std::numbers::sqrt3 / 2 * points_.cell_size();
  const Vec3 at = points_.Relative(place.position).cast<double>();
  const Stick stick(points_.Relative(place.position), half_stick, reach);
  int count = 0;
  for (const PackedPoints::Run& cell : neighbours.cells_) {
    const Vec3 offset = cell.center.cast<double>() - at;
    if (SquaredDistanceFromStick(offset, half_stick) > cell_reach * cell_reach) continue;
    const size_t most = static_cast<size_t>(count + cell.last - cell.first + kLanes);
    if (neighbours.near_.x.size() < most) neighbours.near_.Resize(2 * most);
    count = AppendNear(points_.arrays(), cell, stick, count, neighbours.near_);
  }
  neighbours.near_.Resize(count);
  neighbours.count_ = count;
}

KernelMoments DensityField::Moments(const KernelPlace& place, Neighbours& neighbours) const {
  KernelSums sums(place, sigma_, points_.Relative(place.position));
  if (place.stretch == 1) {
    points_.ForEachRangeNear(place.position, kKernelSupport * sigma_, neighbours.around_,
                             [&](int first, int last) { sums.Add(points_.arrays(), first, last); });
  } else {
    if (!Suffice(neighbours, place)) Gather(place, neighbours);
    sums.Add(neighbours.near_, 0, neighbours.count_);
  }
  return sums.Moments();
}

}  // namespace curvefusion
