#include "fusion/registration/alignment.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "kernel/parallel.h"
#include "kernel/quantile.h"
#include "kernel/rigid_motion.h"
#include "kernel/thinned.h"

namespace curvefusion {

namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

// Chosen: fewer pairs than this, the degrees of freedom of a rigid motion, determine nothing.
constexpr int kMinPairs = 6;
// Chosen: points farther from the target pair with nothing, the largest drift between neighbouring
// bundles.
constexpr double kMaxDistance = 30 * kMillimetre;
// Chosen: the gate for pairs never gets narrower, the noise of a skeleton.
constexpr double kInlierDistance = 4 * kMillimetre;
// Chosen: motions along which the residuals vary this much less than along the best determined one
// are left alone: about the square of the angle by which noise turns tangents.
constexpr double kObservable = 0.01;
// The gate in medians of the distances: 3 sigma of a normal distribution.
constexpr double kGateInMedians = 3 * kGaussianMad;
// Chosen. At rest: a motion of the samples by less than this, in metres.
constexpr double kAtRest = 2e-6;
constexpr int64_t kGrain = 64;  // points for a thread at a time
// What is searched first around a point, in metres. Chosen: most find their target there.
constexpr double kSearchRadius = 0.010;

// What a source point is paired with; target < 0: nothing.
struct Pair {
  int target = -1;
  double distance = 0;  // to the line through the target, or to the target
};

class ClosestPointAligner {
 public:
  ClosestPointAligner(const std::vector<Vec3>& source, const AlignmentTarget& target,
                      const AlignmentOptions& options)
      : source_(source), target_(target.samples()), grid_(target.grid()), options_(options) {}

  // Starts wide and starts narrow, and takes what brings more points close. A wide start finds
  // large drifts; a narrow one is not drawn away by curves that have no counterpart.
  AlignmentResult Align() {
    const AlignmentResult wide = AlignWithin(kMaxDistance);
    const AlignmentResult narrow = AlignWithin(kInlierDistance);
    return Closeness(narrow) > Closeness(wide) ? narrow : wide;
  }

 private:
  AlignmentResult AlignWithin(double max_distance) {
    AlignmentResult result;
    if (source_.empty() || target_.points.empty()) return result;
    max_distance_ = max_distance;
    pairs_.assign(source_.size(), {});
    for (int i = 0; i < options_.max_iterations && !result.converged; ++i) {
      FindPairs(result.T_target_source);
      UpdateGate();
      if (inliers_ < kMinPairs) return result;
      result.converged = Step(result.T_target_source) < kAtRest;
      result.iterations = i + 1;
    }
    FindPairs(result.T_target_source);
    UpdateGate();
    result.inlier_fraction = static_cast<double>(inliers_) / source_.size();
    result.rms = Rms();
    result.center = Center();
    result.information =
        NormalEquations(result.center, 1).first / std::max(result.rms * result.rms, 1e-12);
    return result;
  }

  // How close an alignment brings the points: the sum of their weights with the narrowest gate.
  double Closeness(const AlignmentResult& result) {
    if (result.iterations == 0) return 0;
    FindPairs(result.T_target_source);
    gate_ = kInlierDistance;
    double sum = 0;
    for (const Pair& pair : pairs_) sum += Weight(pair);
    return sum;
  }

  // Tukey's biweight; 0 for what is not paired.
  double Weight(const Pair& pair) const {
    if (pair.target < 0 || pair.distance >= gate_) return 0;
    const double ratio = pair.distance / gate_;
    return (1 - ratio * ratio) * (1 - ratio * ratio);
  }

  // The part of an offset from a target point that counts as distance.
  Vec3 Residual(int target, const Vec3& offset) const {
    if (target_.tangents.empty() || !options_.point_to_line) return offset;
    const Vec3& tangent = target_.tangents[target];
    return offset - tangent.dot(offset) * tangent;
  }

  // The target of the iteration before is near enough to spare most of the search.
  int NearestWithin(const Vec3& p, const Pair& before) const {
    double reach = max_distance_;
    if (before.target >= 0) {
      reach = std::min(reach, (1 + 1e-9) * (p - target_.points[before.target]).norm());
    }
    return grid_.Nearest(p, reach);
  }

  void FindPairs(const RigidTransform& T) {
    moved_.resize(source_.size());
    ParallelFor(0, static_cast<int64_t>(pairs_.size()), kGrain, [&](int64_t i) {
      const Vec3 p = moved_[i] = T * source_[i];
      const int j = NearestWithin(p, pairs_[i]);
      pairs_[i] = {};
      if (j < 0 || (p - target_.points[j]).norm() > max_distance_) return;
      pairs_[i] = {j, Residual(j, p - target_.points[j]).norm()};
    });
  }

  void UpdateGate() {
    std::vector<double> distances;
    for (const Pair& pair : pairs_)
      if (pair.target >= 0) distances.push_back(pair.distance);
    gate_ = kInlierDistance;
    if (!distances.empty()) {
      gate_ = std::clamp(kGateInMedians * Median(std::move(distances)), kInlierDistance,
                         std::max(kInlierDistance, max_distance_));
    }
    inliers_ = static_cast<int>(std::count_if(pairs_.begin(), pairs_.end(), [this](const Pair& p) {
      return p.target >= 0 && p.distance < gate_;
    }));
  }

  double Rms() const {
    double sum = 0;
    for (const Pair& pair : pairs_)
      if (pair.target >= 0 && pair.distance < gate_) sum += pair.distance * pair.distance;
    return inliers_ > 0 ? std::sqrt(sum / inliers_) : 0;
  }

  // Hessian and gradient for a rotation about `center`, in units of 1 / scale, and a translation.
  std::pair<Mat6, Vec6> NormalEquations(const Vec3& center, double scale) const {
    Mat6 hessian = Mat6::Zero();
    Vec6 gradient = Vec6::Zero();
    for (size_t i = 0; i < pairs_.size(); ++i) {
      const Pair& pair = pairs_[i];
      const double weight = Weight(pair);
      if (weight == 0) continue;
      const Vec3 arm = (moved_[i] - center) / scale;
      Eigen::Matrix<double, 3, 6> jacobian;
      for (int axis = 0; axis < 3; ++axis) {
        jacobian.col(axis) = Residual(pair.target, Vec3::Unit(axis).cross(arm));
        jacobian.col(axis + 3) = Residual(pair.target, Vec3::Unit(axis));
      }
      hessian += weight * jacobian.transpose() * jacobian;
      gradient += weight * jacobian.transpose() *
                  Residual(pair.target, moved_[i] - target_.points[pair.target]);
    }
    return {hessian, gradient};
  }

  // One Gauss-Newton step; returns how far it moves the samples.
  double Step(RigidTransform& T) const {
    const Vec3 center = Center();
    const double scale = std::max(1e-6, Spread(center));
    const auto [hessian, gradient] = NormalEquations(center, scale);
    const Vec6 step = ObservableStep(hessian, gradient);
    const Vec3 rotation = step.head<3>() / scale;
    T = RigidMotionAbout(center, rotation, step.tail<3>()) * T;
    T.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
    return step.norm();
  }

  static Vec6 ObservableStep(const Mat6& hessian, const Vec6& gradient) {
    const Eigen::SelfAdjointEigenSolver<Mat6> solver(hessian);
    const double limit = kObservable * solver.eigenvalues().maxCoeff();
    Vec6 step = Vec6::Zero();
    for (int i = 0; i < 6; ++i) {
      const double eigenvalue = solver.eigenvalues()[i];
      if (eigenvalue <= limit) continue;
      const Vec6 direction = solver.eigenvectors().col(i);
      step -= direction * (direction.dot(gradient) / eigenvalue);
    }
    return step;
  }

  Vec3 Center() const {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : moved_) sum += p;
    return sum / static_cast<double>(moved_.size());
  }

  double Spread(const Vec3& center) const {
    double sum = 0;
    for (const Vec3& p : moved_) sum += (p - center).squaredNorm();
    return std::sqrt(sum / static_cast<double>(moved_.size()));
  }

  const std::vector<Vec3>& source_;
  const CurveSamples& target_;
  const PointGrid& grid_;
  const AlignmentOptions& options_;
  std::vector<Pair> pairs_;
  std::vector<Vec3> moved_;
  double max_distance_ = 0;
  double gate_ = 0;
  int inliers_ = 0;
};

}  // namespace

void VisitOptions(AlignmentOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"max_points", "points", 10, 1e6, "Source points used; more are thinned evenly."},
                options.max_points);
  visitor.Visit({"max_iterations", "", 1, 1000, "Limit on iterations."}, options.max_iterations);
  visitor.Visit({"point_to_line", "", 0, 1,
                 "Deviation: measures distances to the lines through the target points, so that "
                 "curves seen in part slide along each other instead of sticking; the paper pairs "
                 "points."},
                options.point_to_line);
}

AlignmentTarget::AlignmentTarget(CurveSamples samples)
    : samples_(std::move(samples)), grid_(samples_.points, kSearchRadius) {
  assert(samples_.tangents.empty() || samples_.tangents.size() == samples_.points.size());
}

AlignmentResult AlignPoints(const std::vector<Vec3>& points, const AlignmentTarget& target,
                            const AlignmentOptions& options) {
  const std::vector<Vec3> thinned = ThinnedTo(points, options.max_points);
  return ClosestPointAligner(thinned, target, options).Align();
}

}  // namespace curvefusion
