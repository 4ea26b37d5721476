#include "fusion/registration/drift_smoothing.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include "kernel/rigid_motion.h"

namespace curvefusion {

namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

// A small motion as rotation vector and as the displacement of a place; this takes the second from
// `from` to `to`.
Mat6 MoveReference(const Vec3& from, const Vec3& to) {
  const Vec3 arm = to - from;
  Mat6 shift = Mat6::Identity();
  for (int axis = 0; axis < 3; ++axis) {
    shift.block<3, 1>(3, axis) = Vec3::Unit(axis).cross(arm);
  }
  return shift;
}

Vec6 ToVector(const RigidTransform& T, const Vec3& center) {
  Vec6 x;
  x << RotationVector(T), T * center - center;
  return x;
}

RigidTransform ToTransform(const Vec6& x, const Vec3& center) {
  return RigidMotionAbout(center, x.head<3>(), x.tail<3>());
}

// The mean of what the measurements look at.
Vec3 CommonCenter(const std::vector<MeasuredCorrection>& measured) {
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (const MeasuredCorrection& correction : measured) {
    if (correction.information.isZero()) continue;
    sum += correction.center;
    ++count;
  }
  return sum / std::max(count, 1);
}

// The normal equations, a block of six for every frame.
class DriftSystem {
 public:
  explicit DriftSystem(size_t frames) : size_(static_cast<Eigen::Index>(6 * frames)) {
    right_side_ = Eigen::VectorXd::Zero(size_);
  }

  void AddBlock(size_t row, size_t column, const Mat6& block) {
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) {
        entries_.emplace_back(static_cast<int>(6 * row) + i, static_cast<int>(6 * column) + j,
                              block(i, j));
      }
    }
  }

  void AddMeasurement(size_t frame, const Mat6& information, const Vec6& value) {
    AddBlock(frame, frame, information);
    right_side_.segment<6>(static_cast<Eigen::Index>(6 * frame)) += information * value;
  }

  void AddStep(size_t frame, const Mat6& information) {
    AddBlock(frame, frame, information);
    AddBlock(frame + 1, frame + 1, information);
    AddBlock(frame, frame + 1, -information);
    AddBlock(frame + 1, frame, -information);
  }

  Eigen::VectorXd Solve() const {
    Eigen::SparseMatrix<double> matrix(size_, size_);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right_side_);
  }

 private:
  Eigen::Index size_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd right_side_;
};

}  // namespace

void VisitOptions(DriftOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"drift_translation", "m", 1e-6, 0.1,
                 "Deviation: how far a pose drifts along an axis from one frame to the next; "
                 "corrections of frames are smoothed accordingly. ORB-SLAM2 at 30 Hz."},
                options.translation_step);
  visitor.Visit({"drift_rotation", "rad", 1e-6, 0.1,
                 "Deviation: how far a pose drifts about an axis from one frame to the next. "
                 "ORB-SLAM2 at 30 Hz."},
                options.rotation_step);
}

std::vector<RigidTransform> SmoothCorrections(const std::vector<MeasuredCorrection>& measured,
                                              const DriftOptions& options) {
  const Vec3 center = CommonCenter(measured);
  Vec6 step;
  step << Vec3::Constant(options.rotation_step), Vec3::Constant(options.translation_step);
  const Mat6 step_information = step.cwiseAbs2().cwiseInverse().asDiagonal();
  // Keeps the system regular where nothing at all was measured; far weaker than any measurement.
  const Mat6 faint = 1e-6 * step_information;
  DriftSystem system(measured.size());
  for (size_t f = 0; f < measured.size(); ++f) {
    const Mat6 to_center = MoveReference(center, measured[f].center);
    const Mat6 information = to_center.transpose() * measured[f].information * to_center /
                             options.points_per_measurement;
    system.AddMeasurement(f, information + faint, ToVector(measured[f].T_registered_world, center));
    if (f + 1 == measured.size()) break;
    const Mat6 to_camera = MoveReference(center, measured[f].camera);
    system.AddStep(f, to_camera.transpose() * step_information * to_camera);
  }
  const Eigen::VectorXd solution = system.Solve();
  std::vector<RigidTransform> smoothed;
  for (size_t f = 0; f < measured.size(); ++f) {
    smoothed.push_back(ToTransform(solution.segment<6>(static_cast<Eigen::Index>(6 * f)), center));
  }
  return smoothed;
}

}  // namespace curvefusion
