#include "fusion/paper/bundle_skeleton.h"

namespace curvefusion {

SkeletonGraph ExtractBundleSkeleton(const std::vector<ObservedPoints>& clusters,
                                    const L1Options& options) {
  SkeletonGraph skeleton;
  for (const ObservedPoints& cluster : clusters) {
    Append(ExtractL1Skeleton(cluster, options), skeleton);
  }
  return skeleton;
}

}  // namespace curvefusion
