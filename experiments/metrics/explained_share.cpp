#include "experiments/metrics/explained_share.h"

#include "experiments/metrics/precision_recall.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr int64_t kGrain = 256;  // points per chunk of a parallel loop

}  // namespace

ExplainingPoints::ExplainingPoints(const std::vector<Vec3>& positions)
    : positions_(positions), index_(positions) {}

int ExplainingPoints::Nearest(const Vec3& p, double reach) const {
  const int nearest = index_.Nearest(p);
  return (positions_[nearest] - p).norm() <= reach ? nearest : -1;
}

double ExplainingPoints::ShareOf(const std::vector<Vec3>& truth,
                                 const RigidTransform& T_truth_result, double reach) const {
  const RigidTransform T_result_truth = T_truth_result.inverse();
  std::vector<double> shares(truth.size());
  ParallelFor(0, static_cast<int64_t>(shares.size()), kGrain, [&](int64_t i) {
    const Vec3 p = T_result_truth * truth[i];
    const int nearest = Nearest(p, reach);
    shares[i] = nearest < 0 ? 0 : 1 - (positions_[nearest] - p).norm() / reach;
  });
  return *Mean(shares);
}

}  // namespace curvefusion
