#include "graph/density_kernel.h"

namespace curvefusion {

void DensityField::Neighbours::Clear() {
  packets_.clear();
  used_lanes_ = 4;
}

void DensityField::Neighbours::Add(const Vec3f& offset, float weight) {
  if (used_lanes_ == 4) {
    const Lanes zero = Lanes::Zero();
    packets_.push_back({zero, zero, zero, zero});
    used_lanes_ = 0;
  }
  Packet& packet = packets_.back();
  packet.x[used_lanes_] = offset.x();
  packet.y[used_lanes_] = offset.y();
  packet.z[used_lanes_] = offset.z();
  packet.weight[used_lanes_] = weight;
  ++used_lanes_;
}

DensityField::DensityField(const ObservedPoints& points, double sigma, double slack)
    : sigma_(sigma),
      reach_(kKernelSupport * sigma + slack),
      weights_(points.counts),
      grid_(points.positions, reach_) {}

void DensityField::Gather(const Vec3& p, Neighbours& neighbours) const {
  neighbours.Clear();
  neighbours.origin_ = p;
  grid_.ForEachWithin(
      p, reach_, [&](int i, const Vec3& q) { neighbours.Add((q - p).cast<float>(), weights_[i]); });
}

KernelMoments DensityField::Moments(const Neighbours& neighbours, const Vec3& p,
                                    const Vec3& direction, double stretch) const {
  using Lanes = Neighbours::Lanes;
  const Vec3f along = direction.cast<float>();
  const float along_scale = static_cast<float>(1 - 1 / (stretch * stretch));
  const Vec3f at = (p - neighbours.origin_).cast<float>();
  const float scale = static_cast<float>(1 / (8 * sigma_ * sigma_));
  Lanes sum = Lanes::Zero(), x = sum, y = sum, z = sum;
  Lanes xx = sum, yy = sum, zz = sum, xy = sum, xz = sum, yz = sum;
  for (const Neighbours::Packet& packet : neighbours.packets_) {
    const Lanes dx = packet.x - at.x();
    const Lanes dy = packet.y - at.y();
    const Lanes dz = packet.z - at.z();
    const Lanes t_along = dx * along.x() + dy * along.y() + dz * along.z();
    const Lanes squared = dx * dx + dy * dy + dz * dz - along_scale * t_along * t_along;
    const Lanes t = (1.0F - scale * squared).max(0.0F);
    const Lanes weight = packet.weight * (t * t) * (t * t);
    const Lanes wx = weight * dx;
    const Lanes wy = weight * dy;
    const Lanes wz = weight * dz;
    sum += weight;
    x += wx;
    y += wy;
    z += wz;
    xx += wx * dx;
    yy += wy * dy;
    zz += wz * dz;
    xy += wx * dy;
    xz += wx * dz;
    yz += wy * dz;
  }
  KernelMoments moments;
  moments.weight = sum.sum();
  if (moments.weight <= 0) return moments;
  moments.mean = Vec3(x.sum(), y.sum(), z.sum()) / moments.weight;
  Mat3 second;
  second << xx.sum(), xy.sum(), xz.sum(), xy.sum(), yy.sum(), yz.sum(), xz.sum(), yz.sum(),
      zz.sum();
  moments.covariance = second / moments.weight - moments.mean * moments.mean.transpose();
  return moments;
}

}  // namespace curvefusion
