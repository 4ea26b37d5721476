#pragma once

#include "kernel/geometry.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// How curve-like a cloud looks from near: the median, over places, of 1 - l2 / l1 for the greatest
/// eigenvalues of the covariance of the points within 10 mm. About 0.5 for wires whose noise is
/// smaller than that; towards 0 where noise blurs them into blobs.
double Linearity(const ObservedPoints& points);

/// How many times larger the noise of points is along their viewing rays than across them, as far
/// as it matters: 1 where the cloud looks like curves as it is (Linearity of at least `enough`),
/// else the ratio, out of powers of two up to 8, whose compression makes it most curve-like; but 1
/// where none makes it 1.7 times as curve-like as it is: what blurs such a cloud is not noise along
/// the rays but wires that are dense or thick, or drift.
double RayNoiseRatio(const ObservedPoints& points, double enough);

/// The linear map that makes the mean noise of the points the same in all directions when it is
/// `ratio` times larger along their viewing rays. Directions without extra noise keep their scale.
AffineTransform NoiseMetric(const ObservedPoints& points, double ratio);

}  // namespace curvefusion
