#include "kernel/options.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

TEST(NearestName, FindsTheLikelyTypo) {
  const std::vector<std::string> known = {"overlap_distance", "voxel_size", "bundle_size"};
  EXPECT_EQ(NearestName("overlap_distanc", known), "overlap_distance");
  EXPECT_EQ(NearestName("voxelsize", known), "voxel_size");
  EXPECT_EQ(NearestName("x", {}), "");
}

}  // namespace
}  // namespace curvefusion
