#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "capture/sequence.h"
#include "fusion/appearance/wire_posterior.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// Places of wires that stand so close that depth images show a surface and colour images hardly a
/// strip by itself: woven seats, baskets, nets. Around what depth shows within `bounds`, up to 10
/// mm before and behind it, a place is one where images agree that they show more wire there than
/// around, and more so than anywhere before and behind. Other things of the wires' colour have such
/// places, too. `posteriors` are the images of how likely the pixels of `frames` show wire, of the
/// colour camera's size, `radius` (metres) is that of the thinnest wires. Counts are those of the
/// images that look. Nothing without depth, and where the bounds are too wide. Costs 1 to 5 s for
/// 40 images. Throws Error(kBadInput) for an image that cannot be decoded.
ObservedPoints FindMeshPlaces(const Sequence& sequence, const std::vector<int>& frames,
                              const std::vector<PosteriorImage>& posteriors,
                              const Eigen::AlignedBox3d& bounds, double radius);

}  // namespace curvefusion
