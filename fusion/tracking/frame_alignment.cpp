#include "fusion/tracking/frame_alignment.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kernel/rigid_motion.h"

namespace curvefusion {

namespace {

// The finest level first. KinectFusion (2011) has 10, 5 and 4 from fine to coarse. Chosen: grey
// needs more at the coarse levels, where it converges from farther off.
constexpr std::array<int, kTrackingLevels> kIterations = {4, 5, 8, 10};
constexpr int kCoarseLevel = 2;       // to which every guess is followed; chosen for speed
constexpr double kSmallTurn = 2e-5;   // derived: radians, less than a hundredth of a pixel
constexpr double kSmallShift = 2e-5;  // derived: metres, about a hundredth of the noise at 1 m
// Errors of neighbouring pixels go together. Chosen: as many that one counts, of images so wide.
constexpr double kCorrelatedPixels = 100;
constexpr double kWidth = 320;
// Standard deviations, chosen wide: they only keep the equations solvable where grey says nothing.
constexpr double kGainPrior = 1;
constexpr double kOffsetPrior = 100;  // grey levels

using Matrix8 = Eigen::Matrix<double, 8, 8>;
using Vector8 = Eigen::Matrix<double, 8, 1>;

// The problem at one level and what is known of its solution.
class LevelSolver {
 public:
  LevelSolver(const TrackingFrame& frame, const ModelView& model, const Keyframe* keyframe,
              const EarlierPose& earlier, const RigidTransform& T_color_depth,
              const PosePrior* prior)
      : frame_(frame),
        model_(model),
        keyframe_(keyframe),
        earlier_(earlier),
        T_color_depth_(T_color_depth),
        prior_(prior) {
    const double scale = frame.levels.front().depth.width() / kWidth;
    correlated_pixels_ = scale * scale * kCorrelatedPixels;
  }

  // A step at a level; whether it was large.
  bool Step(int level, RigidTransform& T_model_frame, GreyChange& change) {
    const FrameLevel& images = frame_.levels[level];
    deviation_ =
        std::max(1.0, MeasureGeometricFit(images, model_.levels[level], T_model_frame).deviation);
    const NormalEquations<6> geometric =
        GeometricTerm(images, model_.levels[level], T_model_frame, deviation_);
    Matrix8 H = Matrix8::Zero();
    Vector8 g = Vector8::Zero();
    H.topLeftCorner<6, 6>() = geometric.H();
    g.head<6>() = geometric.g();
    AddPhotometric(level, T_model_frame, change, H, g);
    AddPrior(T_model_frame, H, g);
    H(6, 6) += 1 / (kGainPrior * kGainPrior);
    H(7, 7) += 1 / (kOffsetPrior * kOffsetPrior);
    g(6) += change.gain / (kGainPrior * kGainPrior);
    g(7) += change.offset / (kOffsetPrior * kOffsetPrior);
    // What no measurement holds stays where it is.
    const Matrix8 damped = H + kDamping * H.diagonal().maxCoeff() * Matrix8::Identity();
    const Vector8 step = -damped.ldlt().solve(g);
    information_ = H;
    if (!step.allFinite()) return false;
    T_model_frame = RigidMotion(step.segment<3>(3), step.head<3>()) * T_model_frame;
    change.gain += step(6);
    change.offset += step(7);
    return step.head<3>().norm() > kSmallShift || step.segment<3>(3).norm() > kSmallTurn;
  }

  void Solve(int level, RigidTransform& T_model_frame, GreyChange& change) {
    for (int i = 0; i < kIterations[level]; ++i) {
      if (!Step(level, T_model_frame, change)) return;
    }
  }

  // How badly a pose explains the images: deviations of depth and grey, over the overlap.
  double Cost(int level, const RigidTransform& T_model_frame, const GreyChange& change) const {
    const FrameLevel& images = frame_.levels[level];
    const GeometricFit fit = MeasureGeometricFit(images, model_.levels[level], T_model_frame);
    double cost = std::max(1.0, fit.deviation) * (1 + fit.measured) / (1 + fit.overlapping);
    if (keyframe_ != nullptr && !images.grey.empty()) {
      cost *= PhotometricTerm(keyframe_->levels[level], images, ViewFrom(T_model_frame), change)
                  .deviation;
    }
    return cost;
  }

  // The change of grey by which to start.
  GreyChange InitialChange(const RigidTransform& T_model_frame) const {
    const int level = kTrackingLevels - 1;
    if (keyframe_ == nullptr || frame_.levels[level].grey.empty()) return {};
    return MatchGrey(keyframe_->levels[level], frame_.levels[level], ViewFrom(T_model_frame));
  }

  // Of the pose, gain and offset eliminated; turns about `center`, over `lever`.
  double Uncertainty(const Vec3& center, double lever) const {
    const Eigen::Matrix<double, 6, 2> cross = information_.topRightCorner<6, 2>();
    const Eigen::Matrix2d grey = information_.bottomRightCorner<2, 2>();
    Eigen::Matrix<double, 6, 6> H =
        information_.topLeftCorner<6, 6>() - cross * grey.inverse() * cross.transpose();
    Eigen::Matrix<double, 6, 6> basis = Eigen::Matrix<double, 6, 6>::Identity();
    // A turn w about the centre moves the origin by -w x center.
    for (int axis = 0; axis < 3; ++axis) {
      basis.block<3, 1>(0, 3 + axis) = -Vec3::Unit(axis).cross(center) / lever;
      basis(3 + axis, 3 + axis) = 1 / lever;
    }
    H = basis.transpose() * H * basis;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(H,
                                                                            Eigen::EigenvaluesOnly);
    const double least = solver.eigenvalues()(0);
    if (!(least > 0)) return std::numeric_limits<double>::infinity();
    return std::sqrt(correlated_pixels_ / least);
  }

  double grey_deviation() const { return grey_deviation_; }

 private:
  PhotometricView ViewFrom(const RigidTransform& T_model_frame) const {
    const RigidTransform T_world_frame = model_.T_world_model * T_model_frame;
    return {model_.T_world_model.inverse() * keyframe_->T_world_camera, T_model_frame,
            ColorFromDepth(frame_, earlier_, T_world_frame, T_color_depth_)};
  }

  void AddPhotometric(int level, const RigidTransform& T_model_frame, const GreyChange& change,
                      Matrix8& H, Vector8& g) {
    const FrameLevel& images = frame_.levels[level];
    if (keyframe_ == nullptr || images.grey.empty()) return;
    const PhotometricSums sums =
        PhotometricTerm(keyframe_->levels[level], images, ViewFrom(T_model_frame), change);
    grey_deviation_ = sums.deviation;
    if (sums.points < PhotometricSums::kMinPoints) return;
    H += sums.equations.H();
    g += sums.equations.g();
  }

  // In the measure of the other terms, of which so many pixels count for one.
  void AddPrior(const RigidTransform& T_model_frame, Matrix8& H, Vector8& g) const {
    if (prior_ == nullptr) return;
    const RigidTransform from_prior =
        T_model_frame * (model_.T_world_model.inverse() * prior_->T_world_camera).inverse();
    Vector8 difference = Vector8::Zero(), weights = Vector8::Zero();
    difference.head<6>() << from_prior.translation(), RotationVector(from_prior);
    weights.head<3>().setConstant(correlated_pixels_ / (prior_->translation * prior_->translation));
    weights.segment<3>(3).setConstant(correlated_pixels_ / (prior_->rotation * prior_->rotation));
    H.diagonal() += weights;
    g += weights.cwiseProduct(difference);
  }

  const TrackingFrame& frame_;
  const ModelView& model_;
  const Keyframe* keyframe_;
  const EarlierPose& earlier_;
  const RigidTransform& T_color_depth_;
  const PosePrior* prior_;
  double correlated_pixels_;
  double deviation_ = 1;
  double grey_deviation_ = 0;
  Matrix8 information_ = Matrix8::Zero();
};

// Products and transposes taken for inverses triple the rounding errors of a rotation from frame to
// frame: after 30 frames they would be degrees.
RigidTransform Orthonormal(const RigidTransform& T) {
  RigidTransform result = RigidTransform::Identity();
  result.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  result.translation() = T.translation();
  return result;
}

// A pose to go on from.
struct Start {
  RigidTransform T_model_frame = RigidTransform::Identity();
  GreyChange change;
  double cost = std::numeric_limits<double>::infinity();
};

// The mean of a frame's points in its camera.
Vec3 Centroid(const FrameLevel& level) {
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (int v = 0; v < level.depth.height(); ++v) {
    for (int u = 0; u < level.depth.width(); ++u) {
      const float z = level.depth(u, v);
      if (!(z > 0)) continue;
      sum += level.depth_camera.Unproject(u, v, z);
      ++count;
    }
  }
  return count == 0 ? Vec3(0, 0, 1) : Vec3(sum / count);
}

}  // namespace

RigidTransform ColorFromDepth(const TrackingFrame& frame, const EarlierPose& earlier,
                              const RigidTransform& T_world_frame,
                              const RigidTransform& T_color_depth) {
  // Chosen: the motion since the frame before is not extrapolated by more than itself.
  constexpr double kMaxShare = 1;
  const double elapsed = frame.timestamp - earlier.timestamp;
  if (frame.color_delay == 0 || elapsed <= 0) return T_color_depth;
  const double share = std::clamp(frame.color_delay / elapsed, -kMaxShare, kMaxShare);
  const RigidTransform motion = earlier.T_world_camera.inverse() * T_world_frame;
  const RigidTransform later =
      RigidMotion(share * RotationVector(motion), share * motion.translation());
  return T_color_depth * later.inverse();
}

FrameAlignment AlignFrame(const TrackingFrame& frame, const ModelView& model,
                          const Keyframe* keyframe, const EarlierPose& earlier,
                          const RigidTransform& T_color_depth,
                          const std::vector<RigidTransform>& T_world_guesses,
                          const PosePrior* prior) {
  LevelSolver solver(frame, model, keyframe, earlier, T_color_depth, prior);
  Start best;
  for (const RigidTransform& T_world_guess : T_world_guesses) {
    Start start;
    start.T_model_frame = model.T_world_model.inverse() * T_world_guess;
    start.change = solver.InitialChange(start.T_model_frame);
    for (int level = kTrackingLevels - 1; level >= kCoarseLevel; --level) {
      solver.Solve(level, start.T_model_frame, start.change);
    }
    start.cost = solver.Cost(kCoarseLevel, start.T_model_frame, start.change);
    if (start.cost < best.cost) best = start;
  }
  for (int level = kCoarseLevel - 1; level >= 0; --level) {
    solver.Solve(level, best.T_model_frame, best.change);
  }
  const Vec3 center = Centroid(frame.levels.back());
  FrameAlignment alignment;
  alignment.T_world_camera = Orthonormal(model.T_world_model * best.T_model_frame);
  alignment.fit = MeasureGeometricFit(frame.levels[0], model.levels[0], best.T_model_frame);
  alignment.grey_deviation = solver.grey_deviation();
  if (keyframe != nullptr) alignment.grey_contrast = keyframe->contrast;
  alignment.cost = solver.Cost(0, best.T_model_frame, best.change);
  alignment.uncertainty = solver.Uncertainty(best.T_model_frame * center, center.norm());
  return alignment;
}

}  // namespace curvefusion
