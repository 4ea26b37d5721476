#include "fusion/tracking/rotation_alignment.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "fusion/tracking/normal_equations.h"
#include "fusion/tracking/photometric_term.h"
#include "kernel/quantile.h"
#include "kernel/rigid_motion.h"

namespace curvefusion {

namespace {

constexpr int kMaxIterations = 12;  // chosen: a start need not be exact
// Radians. Derived: a hundredth of a pixel of the coarsest level.
constexpr double kSmallStep = 2e-4;
constexpr size_t kMinShare = 3;      // chosen: a third of the pixels must be in both images
constexpr double kMinDeviation = 1;  // grey levels; chosen: the step of 8 bits

struct Row {
  float derivatives[4];  // by rotation and by offset of grey
  float residual;
};

GreyStatistics Statistics(const Image<GreySample>& grey) {
  double sum = 0, squares = 0;
  for (const GreySample* s = grey.data(); s != grey.data() + grey.size(); ++s) {
    sum += s->value;
    squares += static_cast<double>(s->value) * s->value;
  }
  const double count = std::max<double>(1, static_cast<double>(grey.size()));
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean))};
}

// Differences of the frame now from the one before, at the pixels of the latter.
std::vector<Row> Rows(const FrameLevel& before, const FrameLevel& now, const GreyChange& change,
                      const Mat3& R_before_now) {
  std::vector<Row> rows;
  const PinholeCamera& camera = before.color_camera;
  for (int v = 0; v < before.grey.height(); ++v) {
    for (int u = 0; u < before.grey.width(); ++u) {
      const Vec3 ray = camera.Unproject(u, v, 1);
      const Vec3 turned = R_before_now.transpose() * ray;
      if (turned.z() <= 0) continue;
      const Vec2 pixel = now.color_camera.Project(turned);
      GreySample sample;
      if (!SampleGrey(now.grey, static_cast<float>(pixel.x()), static_cast<float>(pixel.y()),
                      sample)) {
        continue;
      }
      const double gx = sample.du * now.color_camera.fx / turned.z();
      const double gy = sample.dv * now.color_camera.fy / turned.z();
      const Vec3 by_camera(gx, gy, -(gx * turned.x() + gy * turned.y()) / turned.z());
      const Vec3f by_turn = ray.cross(-(R_before_now * by_camera)).cast<float>();
      rows.push_back({{by_turn.x(), by_turn.y(), by_turn.z(), -1},
                      sample.value - Changed(before.grey(u, v).value, change)});
    }
  }
  return rows;
}

// Deviation of the differences but for a common offset, which exposure makes.
double Deviation(const std::vector<Row>& rows, double& offset) {
  std::vector<double> residuals;
  for (const Row& row : rows) residuals.push_back(row.residual);
  offset = Median(residuals);
  for (double& residual : residuals) residual -= offset;
  return std::max(kMinDeviation, RobustDeviation(std::move(residuals)));
}

Vec3 Step(const std::vector<Row>& rows, double offset, double deviation) {
  NormalEquations<4> sums;
  const auto limit = static_cast<float>(kTukeyLimit * deviation);
  for (const Row& row : rows) {
    const float residual = row.residual - static_cast<float>(offset);
    const float robust = TukeyWeight(residual / limit);
    if (robust > 0) sums.Add(row.derivatives, residual, robust);
  }
  const Eigen::Matrix4d H = sums.H() + 1e-6 * Eigen::Matrix4d::Identity();
  return -H.ldlt().solve(sums.g()).head<3>();
}

}  // namespace

RigidTransform RotationByGrey(const FrameLevel& before, const FrameLevel& now,
                              const RigidTransform& T_before_now) {
  const size_t min_rows = before.grey.size() / kMinShare;
  const GreyChange change = ChangeBetween(Statistics(before.grey), Statistics(now.grey));
  Mat3 R = T_before_now.linear();
  double first_deviation = -1, best_deviation = -1;
  Mat3 best = R;
  for (int i = 0; i <= kMaxIterations; ++i) {
    const std::vector<Row> rows = Rows(before, now, change, R);
    if (rows.size() < min_rows || rows.empty()) break;
    double offset = 0;
    const double deviation = Deviation(rows, offset);
    if (first_deviation < 0) first_deviation = deviation;
    if (best_deviation < 0 || deviation < best_deviation) {
      best_deviation = deviation;
      best = R;
    }
    const Vec3 step = Step(rows, offset, deviation);
    if (!step.allFinite() || step.norm() < kSmallStep) break;
    R = RigidMotion(step, Vec3::Zero()).linear() * R;
  }
  RigidTransform result = T_before_now;
  if (best_deviation < first_deviation) result.linear() = best;
  return result;
}

}  // namespace curvefusion
