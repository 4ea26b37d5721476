#include "graph/density_kernel.h"

#include <cmath>

namespace curvefusion {

namespace {

using Lanes = Eigen::Array4f;
constexpr int kLanes = 4;
// Neighbours do for kernels so far from where they were gathered, in sigma, and turned by an angle
// of this cosine at most: what is then missed lies at the kernel's edge, where it weighs nothing.
constexpr double kSlack = 0.5;
constexpr double kLeastCosine = 0.9;

Lanes Load(const float* values) { return Eigen::Map<const Lanes, Eigen::Unaligned>(values); }

// Ones for the first so many lanes.
constexpr float kFirstLanes[kLanes][kLanes] = {
    {0, 0, 0, 0}, {1, 0, 0, 0}, {1, 1, 0, 0}, {1, 1, 1, 0}};

// The sums that make up moments, four points at a time.
class KernelSums {
 public:
  KernelSums(const KernelPlace& place, double sigma, const Vec3f& at)
      : at_(at),
        along_(place.direction.cast<float>()),
        along_scale_(static_cast<float>(1 - 1 / (place.stretch * place.stretch))),
        scale_(static_cast<float>(1 / (8 * sigma * sigma))) {}

  void Add(const Lanes& x, const Lanes& y, const Lanes& z, const Lanes& weights) {
    const Lanes dx = x - at_.x();
    const Lanes dy = y - at_.y();
    const Lanes dz = z - at_.z();
    const Lanes t_along = dx * along_.x() + dy * along_.y() + dz * along_.z();
    const Lanes squared = dx * dx + dy * dy + dz * dz - along_scale_ * t_along * t_along;
    const Lanes t = (1.0F - scale_ * squared).max(0.0F);
    const Lanes weight = weights * (t * t) * (t * t);
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

  KernelMoments Moments() const {
    KernelMoments moments;
    moments.weight = sum_.sum();
    if (moments.weight <= 0) return moments;
    moments.mean = Vec3(x_.sum(), y_.sum(), z_.sum()) / moments.weight;
    Mat3 second;
    second << xx_.sum(), xy_.sum(), xz_.sum(), xy_.sum(), yy_.sum(), yz_.sum(), xz_.sum(),
        yz_.sum(), zz_.sum();
    moments.covariance = second / moments.weight - moments.mean * moments.mean.transpose();
    return moments;
  }

 private:
  Vec3f at_, along_;
  float along_scale_, scale_;
  Lanes sum_ = Lanes::Zero(), x_ = sum_, y_ = sum_, z_ = sum_;
  Lanes xx_ = sum_, yy_ = sum_, zz_ = sum_, xy_ = sum_, xz_ = sum_, yz_ = sum_;
};

// The stick around which a long kernel extends by as much as across it.
Vec3 HalfStick(const KernelPlace& place, double sigma) {
  return (place.stretch - 1) * kKernelSupport * sigma * place.direction;
}

}  // namespace

DensityField::DensityField(const ObservedPoints& points, double sigma)
    : sigma_(sigma),
      grid_(points.positions, (kKernelSupport + kSlack) * sigma),
      origin_(points.empty() ? Vec3(Vec3::Zero()) : points.positions.front()) {
  // Whole packets are read wherever they start.
  const size_t padded = points.size() + kLanes - 1;
  for (std::vector<float>* values : {&x_, &y_, &z_, &weights_}) values->assign(padded, 0);
  for (size_t i = 0; i < points.size(); ++i) {
    const int point = grid_.order()[i];
    const Vec3f offset = (points.positions[point] - origin_).cast<float>();
    x_[i] = offset.x();
    y_[i] = offset.y();
    z_[i] = offset.z();
    weights_[i] = points.counts[point];
  }
}

bool DensityField::Suffice(const Neighbours& neighbours, const KernelPlace& place) const {
  const KernelPlace& gathered = neighbours.place_;
  if (!neighbours.is_gathered_ || gathered.stretch != place.stretch) return false;
  const double slack = kSlack * sigma_;
  if ((place.position - gathered.position).squaredNorm() > slack * slack) return false;
  return place.stretch == 1 || std::abs(place.direction.dot(gathered.direction)) >= kLeastCosine;
}

void DensityField::Gather(const KernelPlace& place, Neighbours& neighbours) const {
  neighbours.place_ = place;
  neighbours.is_gathered_ = true;
  neighbours.ranges_.clear();
  const double reach = (kKernelSupport + kSlack) * sigma_;
  const Vec3 half_stick = HalfStick(place, sigma_);
  const Vec3 extent = half_stick.cwiseAbs() + Vec3::Constant(reach);
  // Of a column of cells, seen from above, the stick's shadow must come near.
  const Vec2 half_shadow = half_stick.head<2>();
  const double squared_shadow = half_shadow.squaredNorm();
  const double column_reach = reach + grid_.cell_size();
  const auto is_near = [&](double x, double y) {
    const Vec2 offset = Vec2(x, y) - place.position.head<2>();
    const double t =
        squared_shadow > 0 ? std::clamp(offset.dot(half_shadow) / squared_shadow, -1.0, 1.0) : 0;
    return (offset - t * half_shadow).squaredNorm() <= column_reach * column_reach;
  };
  grid_.ForEachRange(place.position - extent, place.position + extent, is_near,
                     [&](int first, int last) { neighbours.ranges_.emplace_back(first, last); });
}

KernelMoments DensityField::Moments(const KernelPlace& place, Neighbours& neighbours) const {
  if (!Suffice(neighbours, place)) Gather(place, neighbours);
  KernelSums sums(place, sigma_, (place.position - origin_).cast<float>());
  for (const auto& [first, last] : neighbours.ranges_) {
    for (int i = first; i < last; i += kLanes) {
      Lanes weights = Load(&weights_[i]);
      if (last - i < kLanes) weights *= Load(kFirstLanes[last - i]);
      sums.Add(Load(&x_[i]), Load(&y_[i]), Load(&z_[i]), weights);
    }
  }
  return sums.Moments();
}

}  // namespace curvefusion
