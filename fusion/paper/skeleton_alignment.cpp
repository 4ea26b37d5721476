#include "fusion/paper/skeleton_alignment.h"

#include <Eigen/Geometry>
#include <vector>

#include "graph/sampled_curves.h"
#include "kernel/parallel.h"
#include "kernel/point_grid.h"

namespace curvefusion {

namespace {

// What is searched first around a sample, metres. Chosen: most find their partner there.
constexpr double kSearchRadius = 10 * kMillimetre;
// Chosen. At rest: samples moved by less than this on average, metres; far below what skeletons
// resolve.
constexpr double kAtRest = 1e-6;
constexpr int64_t kGrain = 256;  // samples for a thread at a time

// The best motion between pairs (Umeyama 1991, which solves what Besl and McKay solve with
// quaternions).
RigidTransform BestMotion(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  const auto n = static_cast<Eigen::Index>(from.size());
  Eigen::Matrix3Xd a(3, n), b(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    a.col(i) = from[i];
    b.col(i) = to[i];
  }
  return RigidTransform(Eigen::umeyama(a, b, false));
}

double MeanMotion(const RigidTransform& T, const std::vector<Vec3>& points) {
  double sum = 0;
  for (const Vec3& p : points) sum += (T * p - p).norm();
  return sum / static_cast<double>(points.size());
}

}  // namespace

void VisitOptions(SkeletonAlignmentOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"sample_step", "m", 1e-4, 0.1,
                 "Distance of samples along curves; CurveFusion 4.3 says dense."},
                options.sample_step);
  visitor.Visit({"max_distance", "m", 1e-4, 1,
                 "Samples farther than this from the other skeleton pair with nothing. Not in the "
                 "paper: a bundle sees curves that the partial skeleton does not have yet."},
                options.max_distance);
  visitor.Visit({"max_iterations", "", 1, 1000, "Limit on iterations. Not in the paper."},
                options.max_iterations);
}

RigidTransform AlignSkeletons(const SkeletonGraph& source, const SkeletonGraph& target,
                              const SkeletonAlignmentOptions& options) {
  std::vector<Vec3> moved = SampleCurvesOf(source, options.sample_step).positions;
  const std::vector<Vec3> fixed = SampleCurvesOf(target, options.sample_step).positions;
  const PointGrid grid(fixed, kSearchRadius);
  RigidTransform T_target_source = RigidTransform::Identity();
  std::vector<int> partners(moved.size());
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    ParallelFor(0, static_cast<int64_t>(moved.size()), kGrain,
                [&](int64_t i) { partners[i] = grid.Nearest(moved[i], options.max_distance); });
    std::vector<Vec3> from, to;
    for (size_t i = 0; i < moved.size(); ++i) {
      if (partners[i] < 0) continue;
      from.push_back(moved[i]);
      to.push_back(fixed[partners[i]]);
    }
    if (from.size() < 3) break;
    const RigidTransform step = BestMotion(from, to);
    const double motion = MeanMotion(step, from);
    for (Vec3& p : moved) p = step * p;
    T_target_source = step * T_target_source;
    if (motion < kAtRest) break;
  }
  return T_target_source;
}

}  // namespace curvefusion
